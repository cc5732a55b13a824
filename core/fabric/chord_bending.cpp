#include "core/fabric/chord_bending.h"

#include <cmath>

#include "core/base/check.h"

namespace pleat {
namespace {

/// E and its derivatives by the chord: [J], [N], [N/m].
struct ChordEnergy {
  double value = 0, slope = 0, curvature = 0;
};

ChordEnergy energy_at(const ChordBend& bend, double chord) {
  const double shortening = 2 * bend.length - chord;
  if (shortening <= 0) return {};
  return {0.5 * bend.stiffness * shortening * shortening, -bend.stiffness * shortening,
          bend.stiffness};
}

}  // namespace

ChordBend chord_bend(VertexId a, VertexId b, double arm, double rigidity) {
  PLEAT_CHECK(arm > 0 && rigidity >= 0, "an arm has length, a rigidity is not negative");
  // Slightly bent, 2L - c = kappa^2 L^3/4: at kappa0 the energy is 1/2 B w L kappa0^2 for this k.
  const double k = 16 * rigidity / (std::pow(arm, 5) * kChordCurvature * kChordCurvature);
  return {a, b, arm, k};
}

double chord_energy(std::span<const ChordBend> bends, const PositionsView& positions) {
  double energy = 0;
  for (const ChordBend& bend : bends)
    energy += energy_at(bend, (positions.col(bend.a) - positions.col(bend.b)).norm()).value;
  return energy;
}

void add_chord_forces(std::span<const ChordBend> bends, const PositionsView& positions,
                      PositionsRef forces) {
  for (const ChordBend& bend : bends) {
    const Vec3 d = positions.col(bend.a) - positions.col(bend.b);
    const double chord = d.norm();
    if (chord == 0) continue;
    const Vec3 pull = energy_at(bend, chord).slope / chord * d;
    forces.col(bend.a) -= pull;
    forces.col(bend.b) += pull;
  }
}

Mat3 chord_stiffness(const ChordBend& bend, const PositionsView& positions,
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
