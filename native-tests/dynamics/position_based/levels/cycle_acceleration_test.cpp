#include "core/dynamics/position_based/levels/cycle_acceleration.h"

#include <Eigen/Dense>
#include <array>
#include <catch2/catch.hpp>
#include <span>
#include <vector>

#include "core/base/random.h"

namespace pleat {
namespace {

constexpr int kSize = 60;  // numbers of a point; as many errors

/// Errors A x - b, and cycles x - P (A x - b) with the preconditioner P.
struct LinearCycles {
  Eigen::MatrixXd A, P;
  Eigen::VectorXd b;

  explicit LinearCycles(Random& random)
      : A(Eigen::MatrixXd::Identity(kSize, kSize)), P(A), b(kSize) {
    for (double& number : A.reshaped()) number += 0.1 * random.uniform(-1, 1);
    for (int i = 0; i < kSize; ++i) P(i, i) = random.uniform(0.2, 0.8);
    for (double& number : b) number = random.uniform(-1, 1);
  }

  Eigen::VectorXd errors(const Eigen::VectorXd& x) const { return A * x - b; }

  /// |A x - b| after so many cycles of GMRES from x: least squares over what P A makes of P e.
  double left_by_gmres(const Eigen::VectorXd& x, int n_cycles) const {
    const Eigen::VectorXd e = errors(x);
    if (n_cycles == 0) return e.norm();
    Eigen::MatrixXd basis(kSize, n_cycles);
    basis.col(0) = (P * e).normalized();
    for (int k = 1; k < n_cycles; ++k) basis.col(k) = (P * (A * basis.col(k - 1))).normalized();
    const Eigen::MatrixXd images = A * basis;
    return (e - images * images.colPivHouseholderQr().solve(e)).norm();
  }
};

/// A point in two arrays, under acceleration.
struct Accelerated {
  CycleAcceleration acceleration;
  std::vector<float> head, tail, errors;

  Accelerated() : head(8, 0), tail(kSize - 8, 0), errors(kSize, 0) { acceleration.begin(); }

  Eigen::VectorXd point() const {
    Eigen::VectorXd x(kSize);
    for (int i = 0; i < kSize; ++i)
      x[i] = i < 8 ? head[static_cast<std::size_t>(i)] : tail[static_cast<std::size_t>(i - 8)];
    return x;
  }

  /// A cycle from the point to `image`; true when something was foretold from it.
  template <class Errors>
  bool cycle(const Eigen::VectorXd& image, Errors&& errors_at) {
    for (int i = 0; i < kSize; ++i)
      (i < 8 ? head[static_cast<std::size_t>(i)] : tail[static_cast<std::size_t>(i - 8)]) =
          static_cast<float>(image[i]);
    const auto look = [&] {
      const Eigen::VectorXd now = errors_at(point());
      for (int i = 0; i < kSize; ++i)
        errors[static_cast<std::size_t>(i)] = static_cast<float>(now[i]);
    };
    const std::array<std::span<float>, 2> arrays = {head, tail};
    look();
    const bool is_foretold = acceleration.propose(arrays, errors);
    if (is_foretold) look();
    acceleration.settle(arrays, errors);
    return is_foretold;
  }
};

}  // namespace

TEST_CASE("cycle acceleration: with linear errors cycles leave what GMRES does", "[dynamics]") {
  Random random(GENERATE(1U, 2U, 3U));
  const LinearCycles linear(random);
  Accelerated accelerated;
  const auto errors_at = [&](const Eigen::VectorXd& x) { return linear.errors(x); };
  const auto cycle = [&] {
    const Eigen::VectorXd x = accelerated.point();
    return accelerated.cycle(x - linear.P * linear.errors(x), errors_at);
  };
  CHECK_FALSE(cycle());  // nothing before it
  const Eigen::VectorXd first = accelerated.point();
  for (int n_cycles = 1; n_cycles <= 4; ++n_cycles) {  // the window is not full
    CAPTURE(n_cycles);
    CHECK(cycle());
    // Single precision, and the millionth that holds nearly parallel differences apart.
    CHECK(linear.errors(accelerated.point()).norm() ==
          Approx(linear.left_by_gmres(first, n_cycles)).epsilon(1e-3));
  }
  const double before = linear.errors(accelerated.point()).norm();
  for (int more = 0; more < 8; ++more) cycle();
  CHECK(linear.errors(accelerated.point()).norm() < 0.1 * before);
}

TEST_CASE("cycle acceleration: a proposal with more error is taken back, and all before forgotten",
          "[dynamics]") {
  Random random(4);
  Accelerated accelerated;
  std::array<Eigen::VectorXd, 3> images;
  for (Eigen::VectorXd& image : images) {
    image.resize(kSize);
    for (double& number : image) number = random.uniform(-1, 1);
    image = image.cast<float>().cast<double>();
  }
  const auto are_the_point = [](const Eigen::VectorXd& x) { return x; };
  accelerated.cycle(images[0], are_the_point);
  const auto far_more_elsewhere = [&](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(x == images[1] ? x : 100 * Eigen::VectorXd::Ones(kSize));
  };
  CHECK(accelerated.cycle(images[1], far_more_elsewhere));
  CHECK(accelerated.point() == images[1]);
  CHECK(accelerated.errors[3] == static_cast<float>(images[1][3]));
  // The point next to the origin on the line from the second to the third.
  CHECK(accelerated.cycle(images[2], are_the_point));
  const Eigen::VectorXd way = images[1] - images[2];
  const Eigen::VectorXd nearest = images[2] - images[2].dot(way) / way.squaredNorm() * way;
  CHECK((accelerated.point() - nearest).norm() < 1e-5 * nearest.norm());
}

}  // namespace pleat
