#include "core/run/example_study.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/files/plan_file.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

Scene sheet_scene(int level) {
  Scene scene = released_sheet_scene(4, "canvas");
  scene.level = level;
  return scene;
}

/// The flat fine mesh rolled up along its length without stretch, the more the later the frame.
Positions rolled(const QuadMesh& mesh, int frame) {
  Positions x = mesh.rest_positions();
  const Vec3 low = x.rowwise().minCoeff();
  const Vec3 extent = x.rowwise().maxCoeff() - low;
  Eigen::Index along = 0;
  Eigen::Index across = 0;
  const double length = extent.maxCoeff(&along);
  extent.minCoeff(&across);
  const double radius = length / (0.5 * (1 + frame));
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const double angle = (x(along, i) - low[along]) / radius;
    x(along, i) = low[along] + radius * std::sin(angle);
    x(across, i) += radius * (1 - std::cos(angle));
  }
  return x;
}

}  // namespace

TEST_CASE("example study: limits are those of all frames, and need one", "[run]") {
  ExampleStudy study(sheet_scene(1));
  BendFeatures features = BendFeatures::Zero(2, study.fine().n_vertices());
  for (Eigen::Index i = 0; i < features.cols(); ++i) features(0, i) = static_cast<double>(i);
  study.add_example("by hand", features, {});
  PlanOptions options;
  options.criterion = PlanCriterion::curvature;
  CHECK(study.plan(options).curvature_limits.empty());
  study.add_frame(rolled(study.fine(), 0));
  const double first = study.plan(options).curvature_limits.front();
  study.add_frame(rolled(study.fine(), 1));
  CHECK(study.plan(options).curvature_limits.front() > first);
}

TEST_CASE("example study: what is lost is of the frames since the last example", "[run]") {
  // A slight bend alone loses less than both examples, of which the stronger one counts.
  const auto n_vertices = [](std::initializer_list<int> frames) {
    ExampleStudy study(sheet_scene(2));
    BendFeatures features = BendFeatures::Random(2, study.fine().n_vertices());
    for (const int frame : frames) {
      study.add_frame(rolled(study.fine(), frame));
      study.add_example("rolled", features, {});
    }
    PlanOptions options;
    options.largest_loss = 0.003;
    return study.plan(options).n_vertices;
  };
  CHECK(n_vertices({0}) == 25);
  CHECK(n_vertices({1}) > 25);
  CHECK(n_vertices({0, 1}) == n_vertices({1}));
  CHECK(n_vertices({1, 0}) == n_vertices({1}));
}

TEST_CASE("example study: features are those of the frames from one on", "[run]") {
  ExampleStudy all(sheet_scene(1));
  ExampleStudy last_two(sheet_scene(1));
  for (int frame = 0; frame < 4; ++frame) {
    all.add_frame(rolled(all.fine(), frame));
    if (frame >= 2) last_two.add_frame(rolled(all.fine(), frame));
  }
  CHECK(all.features(2) == last_two.features());
  CHECK(all.features() != last_two.features());
}

TEST_CASE("example study: what is no example, frame or feature is refused", "[run]") {
  CHECK_THROWS_AS(ExampleStudy(sheet_scene(0)), InputError);
  ExampleStudy study(sheet_scene(1));
  CHECK_THROWS_AS(study.plan({}), InputError);
  CHECK_THROWS_AS(study.add_frame(Positions::Zero(3, 3)), InputError);
  CHECK_THROWS_WITH(study.add_frame(Positions::Constant(3, study.fine().n_vertices(), NAN)),
                    "expected finite places, got others in frame 0");
  study.add_example("no frames", BendFeatures::Random(2, study.fine().n_vertices()), {});
  CHECK_THROWS_WITH(study.plan({}), Catch::Contains("expected frames of each example"));
  CHECK_THROWS_AS(study.add_example("short", BendFeatures::Zero(2, 3), {}), InputError);
}

}  // namespace pleat
