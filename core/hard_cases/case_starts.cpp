#include "core/hard_cases/case_starts.h"

#include <cmath>
#include <numbers>

#include "core/base/random.h"

namespace pleat {
namespace {

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

}  // namespace

Positions in_one_point(const Positions& rest) { return rest.col(0).replicate(1, rest.cols()); }

Positions folded_in_half(const Positions& rest) {
  Positions folded = rest;
  folded.row(2) = -rest.row(2).array().abs();
  return folded;
}

Positions on_a_line(const Positions& rest) {
  Positions line = Positions::Zero(3, rest.cols());
  line.row(1) = rest.row(1);
  return line;
}

Positions with_neighbours_swapped(const Positions& rest) {
  Positions swapped = rest;
  const double near = 1.5 * (rest.col(1) - rest.col(0)).norm();
  for (Eigen::Index i = 0; i + 1 < rest.cols(); i += 2)
    if ((rest.col(i + 1) - rest.col(i)).norm() <= near) swapped.col(i).swap(swapped.col(i + 1));
  return swapped;
}

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

}  // namespace pleat
