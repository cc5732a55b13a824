#include "core/fabric/chord_bending.h"

#include <cmath>

#include "core/base/check.h"

namespace pleat {
namespace {

/// E and its derivatives by the chord: [J], [N], [N/m].
struct ChordEnergy {
  double value = 0, slope = 0, curvature = 0;
};

/// (1 - phi r/s)/s^2 with r = cos phi and s = sin phi; its series 1/3 + 2/15 s^2 where the
/// difference cancels.
double arc_softening(double phi, double r, double s) {
  constexpr double kSeries = 1e-5;  // limit of s^2: both forms are good to 1e-10 here
  const double square = s * s;
  return square < kSeries ? 1.0 / 3 + 2.0 / 15 * square : (1 - phi * r / s) / square;
}

/// Energy of a chord bent to an arc, with r = c/2L = cos phi and kappa = 2 phi/L:
///
///     E = 2 B w phi^2/L,   E' = -2 B w/L^2 (phi/sin phi),   E'' = B w/L^3 (1 - phi r/s)/s^2.
ChordEnergy arc_energy(double stiffness, double length, double chord) {
  const double r = chord / (2 * length);
  const double s = std::sqrt((1 - r) * (1 + r));
  const double phi = std::atan2(s, r);
  const double scale = stiffness / length;
  return {2 * scale * phi * phi, -2 * scale / length * (s > 0 ? phi / s : 1),
          scale / (length * length) * arc_softening(phi, r, s)};
}

ChordEnergy energy_at(const ChordBend& bend, double chord) {
  const double shortening = 2 * bend.length - chord;
  if (shortening <= 0) return {};
  if (bend.law == ChordLaw::arc) return arc_energy(bend.stiffness, bend.length, chord);
  return {0.5 * bend.stiffness * shortening * shortening, -bend.stiffness * shortening,
          bend.stiffness};
}

}  // namespace

ChordBend chord_bend(VertexId a, VertexId b, double arm, double rigidity, ChordLaw law) {
  PLEAT_CHECK(arm > 0 && rigidity >= 0, "an arm has length, a rigidity is not negative");
  // Slightly bent, 2L - c = kappa^2 L^3/4: both laws agree at kappa0 for this k.
  const double k = 16 * rigidity / (std::pow(arm, 5) * kLinearLawCurvature * kLinearLawCurvature);
  return {a, b, arm, law == ChordLaw::arc ? rigidity : k, law};
}

double chord_energy(std::span<const ChordBend> bends,
                    const Eigen::Ref<const Positions>& positions) {
  double energy = 0;
  for (const ChordBend& bend : bends)
    energy += energy_at(bend, (positions.col(bend.a) - positions.col(bend.b)).norm()).value;
  return energy;
}

void add_chord_forces(std::span<const ChordBend> bends,
                      const Eigen::Ref<const Positions>& positions, Eigen::Ref<Positions> forces) {
  for (const ChordBend& bend : bends) {
    const Vec3 d = positions.col(bend.a) - positions.col(bend.b);
    const double chord = d.norm();
    if (chord == 0) continue;
    const Vec3 pull = energy_at(bend, chord).slope / chord * d;
    forces.col(bend.a) -= pull;
    forces.col(bend.b) += pull;
  }
}

Mat3 chord_stiffness(const ChordBend& bend, const Eigen::Ref<const Positions>& positions,
                     ElementHessian hessian) {
  const Vec3 d = positions.col(bend.a) - positions.col(bend.b);
  const double chord = d.norm();
  if (chord == 0) return Mat3::Zero();
  const Vec3 u = d / chord;
  const ChordEnergy at = energy_at(bend, chord);
  const double across = hessian == ElementHessian::exact ? at.slope / chord : 0;  // never positive
  return across * Mat3::Identity() + (at.curvature - across) * u * u.transpose();
}

}  // namespace pleat
