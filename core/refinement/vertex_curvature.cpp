#include "core/refinement/vertex_curvature.h"

#include <array>
#include <cmath>

#include "core/base/check.h"
#include "core/mesh/mesh_lines.h"

namespace pleat {
namespace {

/// Coefficients of t(e), from inverting e = 1 - sin(sqrt t) / sqrt t = t/6 - t^2/120 + ...
/// All are positive and the series converges up to e = 1.217, where the sine cardinal turns.
constexpr std::array<double, 9> kSeries = {6.0,
                                           9.0 / 5,
                                           144.0 / 175,
                                           78.0 / 175,
                                           89226.0 / 336875,
                                           522063.0 / 3128125,
                                           83924688.0 / 766390625,
                                           438337548.0 / 5922109375,
                                           286914949362.0 / 5606147421875};

/// Up to here the terms left out are below 1e-12 of the sum, and from here on 1 - sin(a) / a loses
/// two digits at most.
constexpr double kSeriesEnd = 0.06;

double series(double e) {
  double sum = 0;
  for (std::size_t k = kSeries.size(); k-- > 0;) sum = e * (kSeries[k] + sum);
  return sum;
}

/// The half angle a [rad] of an arc that is 1 / (1 - e) times as long as its chord: sin(a)/a = 1 -
/// e.
///
/// Newton's method in t = a^2, of which the sine cardinal is a falling convex function. The cut
/// series begins below the root, and from there each step stays below it.
double half_angle(double e) {
  constexpr int kMaxSteps = 5;         // three are enough at e = 1
  constexpr double kRounding = 1e-15;  // relative to t
  double t = series(e);
  if (e < kSeriesEnd) return std::sqrt(t);
  for (int step = 0; step < kMaxSteps; ++step) {
    const double a = std::sqrt(t);
    const double sinc = std::sin(a) / a;
    const double change = 2 * t * (sinc - 1 + e) / (sinc - std::cos(a));
    t += change;
    if (std::abs(change) < kRounding * t) break;
  }
  return std::sqrt(t);
}

}  // namespace

double arc_curvature(double chord, double length) {
  PLEAT_CHECK(chord >= 0 && length > 0, "a chord has no negative length, an arc a positive one");
  if (chord >= length) return 0;
  return 2 * half_angle((length - chord) / length) / length;
}

VertexCurvature::VertexCurvature(const QuadMesh& mesh) : hanging_(mesh.hanging_vertices()) {
  for (const LineChord& chord : line_chords(mesh, thread_edges(mesh)))
    arcs_.push_back({chord.before, chord.after, chord.arm_before + chord.arm_after});
  const Positions& x = mesh.rest_positions();
  for (const DiagonalChord& chord : diagonal_chords(mesh))
    arcs_.push_back({chord.before, chord.after,
                     (x.col(chord.before) - x.col(chord.middle)).norm() +
                         (x.col(chord.after) - x.col(chord.middle)).norm()});
  shares_ = Eigen::VectorXd::Zero(mesh.n_vertices());
  for (const Arc& arc : arcs_)
    for (const VertexId v : {arc.a, arc.b}) ++shares_[v];
  shares_ = (shares_.array() > 0).select(shares_.cwiseInverse(), 0);
}

Eigen::VectorXd VertexCurvature::of(const PositionsView& positions) const {
  PLEAT_CHECK(positions.cols() == shares_.size(), "one position per vertex");
  Eigen::VectorXd curvature = Eigen::VectorXd::Zero(shares_.size());
  for (const Arc& arc : arcs_) {
    const double chord = (positions.col(arc.a) - positions.col(arc.b)).norm();
    const double of_arc = arc_curvature(chord, arc.length);
    curvature[arc.a] += of_arc;
    curvature[arc.b] += of_arc;
  }
  curvature.array() *= shares_.array();
  for (const HangingVertex& h : hanging_)
    curvature[h.vertex] = (curvature[h.parents[0]] + curvature[h.parents[1]]) / 2;
  return curvature;
}

}  // namespace pleat
