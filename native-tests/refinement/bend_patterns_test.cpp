#include "core/refinement/bend_patterns.h"

#include <catch2/catch.hpp>
#include <limits>

#include "core/base/check.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

/// A sheet in the plane z = 0 whose second half along x swings between flat and a cylinder.
Positions half_rolled(const QuadMesh& mesh, double radius) {
  Positions x = mesh.rest_positions();
  for (auto point : x.colwise()) {
    const double beyond = point.x() - 0.5;
    if (beyond <= 0) continue;
    point.x() = 0.5 + radius * std::sin(beyond / radius);
    point.z() = radius * (1 - std::cos(beyond / radius));
  }
  return x;
}

/// Three groups, calm in the middle of the list.
BendFeatures three_groups() {
  BendFeatures features(2, 9);
  features.row(0) << 10, 11, 12, 3, 3.5, 4, 30, 31, 32;
  features.row(1) << 2, 2.1, 2.2, 1, 1.1, 1.2, 5, 5, 5.5;
  return features;
}

}  // namespace

TEST_CASE("bend features: they are mean and standard deviation over the frames", "[refinement]") {
  const QuadMesh mesh = lying_sheet(6);
  const VertexCurvature curvature(mesh);
  BendFeatureSum sum(mesh);
  Eigen::MatrixXd all(mesh.n_vertices(), 5);
  for (int frame = 0; frame < 5; ++frame) {
    const Positions x = half_rolled(mesh, 0.3 + 0.1 * frame);
    all.col(frame) = curvature.of(x);
    sum.add(x);
  }
  CHECK(sum.n_frames() == 5);
  const BendFeatures features = sum.features();
  const Eigen::VectorXd mean = all.rowwise().mean();
  const Eigen::VectorXd variance = (all.colwise() - mean).rowwise().squaredNorm() / 5;
  CHECK((features.row(0).transpose() - mean).norm() < 1e-12);
  CHECK((features.row(1).transpose() - variance.cwiseSqrt()).norm() < 1e-12);
  CHECK(features.row(1).maxCoeff() > 0.1);
}

TEST_CASE("bend features: a long calm motion does not drown in rounding", "[refinement]") {
  const QuadMesh mesh = lying_sheet(4);
  BendFeatureSum sum(mesh);
  // Two shapes in turn: deviation is half of their difference whatever the length.
  const VertexCurvature curvature(mesh);
  const Positions a = half_rolled(mesh, 0.3);
  const Positions b = half_rolled(mesh, 0.3 * (1 + 1e-7));
  for (int i = 0; i < 2000; ++i) sum.add(i % 2 == 0 ? a : b);
  const Eigen::VectorXd expected = (curvature.of(a) - curvature.of(b)).cwiseAbs() / 2;
  CHECK((sum.features().row(1).transpose() - expected).norm() < 1e-3 * expected.norm());
}

TEST_CASE("bend features: frames that do not fit are named", "[refinement]") {
  const QuadMesh mesh = lying_sheet(3);
  BendFeatureSum sum(mesh);
  CHECK_THROWS_AS(sum.features(), InputError);
  sum.add(mesh.rest_positions());
  CHECK_THROWS_WITH(sum.features(), "frames: expected at least 2, got 1");
  const auto where = [&](const Positions& frame) -> std::string {
    try {
      sum.add(frame);
      return "nowhere";
    } catch (const InputError& error) {
      return error.where() + ": " + error.sentence();
    }
  };
  CHECK(where(Positions::Zero(3, 15)) == "frame 1: expected 16 vertices as the mesh has, got 15");
  Positions spoilt = mesh.rest_positions();
  spoilt(1, 7) = std::numeric_limits<double>::quiet_NaN();
  CHECK(where(spoilt) == "frame 1: expected finite positions, got none at vertex 7");
  CHECK(where(mesh.rest_positions()) == "nowhere");
}

TEST_CASE("bend patterns: they are ranked from calm to bent and read in 1/m", "[refinement]") {
  const BendPatterns patterns = bend_patterns(three_groups());
  CHECK(patterns.of_vertices == std::vector<int>{1, 1, 1, 0, 0, 0, 2, 2, 2});
  CHECK(patterns.centres(0, 0) == Approx(3.5));
  CHECK(patterns.centres(0, 1) == Approx(11));
  CHECK(patterns.centres(0, 2) == Approx(31));
  CHECK(patterns.centres(1, 1) == Approx(2.1));
  CHECK(patterns.low == Eigen::Vector2d(3, 1));
  CHECK(patterns.high == Eigen::Vector2d(32, 5.5));
}

TEST_CASE("bend patterns: normalised ones do not depend on how strongly a fabric bends",
          "[refinement]") {
  Random random(4);
  BendFeatures features(2, 500);
  for (int i = 0; i < 500; ++i) features.col(i) << random.uniform(0, 40), random.uniform(0, 80);
  BendFeatures stiff = features;
  stiff.row(0) *= 0.25;
  stiff.row(1) *= 0.0625;
  CHECK(bend_patterns(stiff).of_vertices == bend_patterns(features).of_vertices);
  PatternOptions raw;
  raw.normalised = false;
  CHECK(bend_patterns(stiff, raw).of_vertices != bend_patterns(features, raw).of_vertices);
  CHECK(bend_patterns(features, raw).high == Eigen::Vector2d(1, 1));
}

TEST_CASE("bend patterns: the same seed gives the same patterns", "[refinement]") {
  Random random(9);
  BendFeatures features(2, 800);
  for (int i = 0; i < 800; ++i) features.col(i) << random.uniform(0, 40), random.uniform(0, 9);
  CHECK(bend_patterns(features).of_vertices == bend_patterns(features).of_vertices);
}

TEST_CASE("bend patterns: options out of range and too few features are refused", "[refinement]") {
  PatternOptions options;
  options.n_patterns = 0;
  CHECK_THROWS_AS(bend_patterns(three_groups(), options), InputError);
  options.n_patterns = kMaxPatterns + 1;
  CHECK_THROWS_AS(bend_patterns(three_groups(), options), InputError);
  options.n_patterns = 10;
  CHECK_THROWS_WITH(bend_patterns(three_groups(), options), Catch::Contains("which is 9"));
  options = {};
  options.n_runs = 0;
  CHECK_THROWS_AS(bend_patterns(three_groups(), options), InputError);
  CHECK_THROWS_WITH(bend_patterns(BendFeatures::Ones(2, 7)), Catch::Contains("which is 1"));
}

TEST_CASE("bend patterns: the half of a sheet that moves is found", "[refinement]") {
  const QuadMesh mesh = lying_sheet(24);
  BendFeatureSum sum(mesh);
  for (int frame = 0; frame < 20; ++frame) sum.add(half_rolled(mesh, 0.2 + 0.05 * frame));
  PatternOptions options;
  options.n_patterns = 2;
  const BendPatterns patterns = bend_patterns(sum.features(), options);
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    const double x = mesh.rest_positions()(0, v);
    if (x < 0.4) CHECK(patterns.of_vertices[static_cast<std::size_t>(v)] == 0);
    if (x > 0.6) CHECK(patterns.of_vertices[static_cast<std::size_t>(v)] == 1);
  }
}

}  // namespace pleat
