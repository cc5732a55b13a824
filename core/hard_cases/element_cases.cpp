#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/hard_cases/case_checks.h"
#include "core/hard_cases/hard_case_table.h"

namespace pleat {
namespace {

// Places in which cases begin, made from those at rest [m].

using std::numbers::pi;

struct Wave {
  Vec3 wave;    // [1/m]
  Vec3 height;  // [m]
  double phase;
};

Vec3 random_direction(Random& random) {
  return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
}

/// Random wave 2 to 20 cm long, a quarter as high.
Wave random_wave(double share, Random& random) {
  const double length = 0.02 * std::pow(10, share);
  return {2 * pi / length * random_direction(random), length / 4 * random_direction(random),
          random.uniform(0, 2 * pi)};
}

/// Every vertex where the first is.
Positions in_one_point(const Positions& rest) { return rest.col(0).replicate(1, rest.cols()); }

/// The half beyond z = 0 laid back onto the other.
Positions folded_in_half(const Positions& rest) {
  Positions folded = rest;
  folded.row(2) = -rest.row(2).array().abs();
  return folded;
}

/// Everything on the line x = z = 0.
Positions on_a_line(const Positions& rest) {
  Positions line = Positions::Zero(3, rest.cols());
  line.row(1) = rest.row(1);
  return line;
}

/// Each second vertex changes its place with the next, where that is near.
Positions with_neighbours_swapped(const Positions& rest) {
  Positions swapped = rest;
  const double near = 1.5 * (rest.col(1) - rest.col(0)).norm();
  for (Eigen::Index i = 0; i + 1 < rest.cols(); i += 2)
    if ((rest.col(i + 1) - rest.col(i)).norm() <= near) swapped.col(i).swap(swapped.col(i + 1));
  return swapped;
}

/// A vertical sheet rolled round the y axis, one side meeting the other.
Positions rolled_up(const Positions& rest) {
  const double width = rest.row(0).maxCoeff() - rest.row(0).minCoeff();
  const double radius = width / (2 * pi);
  Positions rolled = rest;
  for (Eigen::Index i = 0; i < rest.cols(); ++i) {
    const double angle = rest(0, i) / radius;
    rolled(0, i) = radius * std::sin(angle);
    rolled(2, i) = radius * std::cos(angle);
  }
  return rolled;
}

/// A heap of half the cloth's size, crumpled in waves of 2 to 20 cm in all directions.
Positions crumpled(const Positions& rest) {
  constexpr int kWaves = 24;
  constexpr double kSize = 0.5;  // share of the cloth's size
  Random random(1);
  const Vec3 centre = rest.rowwise().mean();
  Positions heap = (kSize * (rest.colwise() - centre)).colwise() + centre;
  const Positions smooth = heap;
  for (int k = 0; k < kWaves; ++k) {
    const Wave wave = random_wave(k / (kWaves - 1.0), random);
    const Eigen::RowVectorXd swing = (wave.wave.transpose() * smooth).array() + wave.phase;
    heap += wave.height * swing.array().sin().matrix() / std::sqrt(kWaves / 3.0);
  }
  return heap;
}

}  // namespace

std::vector<HardCase> element_cases() {
  return {
      {.name = "stiffness_ratio",
       .breaks = "Iterative solvers stall where threads along warp are a million times as stiff as "
                 "those along weft.",
       .seconds = {1, 4},
       .checks = {no_nonsense(), stays_within(10)}},
      {.name = "heavy_bead",
       .breaks =
           "A bead 10 000 times as heavy as its neighbours pulls the springs around it apart.",
       .seconds = {2, 10},
       .checks = {no_nonsense(), stays_within(10)}},
      {.name = "long_step_stiff_cloth",
       .breaks =
           "Leather in steps of 1/30 s is beyond what explicit and loosely solved steps bear.",
       .seconds = {3, 10},
       .checks = {no_nonsense(), stays_within(3)}},
      {.name = "hundredfold_stiffness",
       .breaks = "Cloth a hundred times as stiff as any that was measured: rounding and tolerances "
                 "that were tuned to fabrics.",
       .seconds = {1, 5},
       .checks = {no_nonsense(), stays_within(3)}},
      {.name = "one_point",
       .breaks = "Springs without a length have no direction, and a division by it makes NaN.",
       .seconds = {3, 10},
       .start = in_one_point,
       .checks = {speeds_explained(), stays_within(10)}},
      {.name = "collapsed_to_a_line",
       .breaks = "Triangles without an area have no normal.",
       .seconds = {1, 10},
       .start = on_a_line,
       .checks = {speeds_explained(), stays_within(10)}},
      {.name = "zero_length_springs",
       .breaks = "Springs whose rest length is zero divide by it, or never come to rest.",
       .seconds = {2, 10},
       .checks = {speeds_explained(), stays_within(3)}},
      {.name = "folded_flat",
       .breaks = "A sheet that lies on itself in a fold without a radius: bending without a bound.",
       .seconds = {2, 10},
       .start = folded_in_half,
       .checks = {speeds_explained(), stays_within(3)}},
      {.name = "inverted_quads",
       .breaks = "Quads that are turned inside out stay so, or explode on their way back.",
       .seconds = {1, 10},
       .start = with_neighbours_swapped,
       .checks = {speeds_explained(), stays_within(10)}},
      {.name = "needle_triangles",
       .breaks = "Triangles a thousand times as long as wide make ill-conditioned matrices.",
       .seconds = {0.5, 5},
       .checks = {speeds_explained(), stays_within(3)}},
      {.name = "needle_cells",
       .breaks = "The same needles as springs: two kinds of edges, one a thousand times as long.",
       .seconds = {0.5, 5},
       .checks = {speeds_explained(), stays_within(3)}},
      {.name = "crushed_tube",
       .breaks = "A tube crushed along its axis buckles in a cascade.",
       .seconds = {1.5, 5},
       .start = rolled_up,
       .checks = {speeds_explained(), stays_within(3)}},
      {.name = "fold_across_a_border",
       .breaks = "A fold that runs across a border of refinement breaks at hanging vertices.",
       .seconds = {2, 4},
       .checks = {no_nonsense(), stays_within(3)}},
      {.name = "hanging_vertices_at_pins",
       .breaks = "A vertex that hangs between pinned ones is held twice.",
       .seconds = {2, 4},
       .checks = {no_nonsense(), stays_within(3)}},
      {.name = "crumpled",
       .breaks = "28 000 vertices that begin crumpled, every edge at another strain.",
       .seconds = {0.5, 0.5},
       .brief_changes = {{"/cloth/sheet/rows", 24}, {"/cloth/sheet/columns", 24}},
       .start = crumpled,
       .checks = {speeds_explained(), stays_within(20)}},
      {.name = "fine_curtain",
       .breaks =
           "129 x 129 vertices: a stretch of 180 % and 36 s a step were seen on the page, with "
           "implicit.",
       .seconds = {1, 1},
       .brief_changes = {{"/refinement/level", 1}},
       .checks = {no_nonsense(), stays_within(5)}},
  };
}

}  // namespace pleat
