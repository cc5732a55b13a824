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
  CHECK(study.plan({}).curvature_limits.empty());
  study.add_frame(rolled(study.fine(), 0));
  const double first = study.plan({}).curvature_limits.front();
  study.add_frame(rolled(study.fine(), 1));
  CHECK(study.plan({}).curvature_limits.front() > first);
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
  CHECK_THROWS_AS(study.add_example("short", BendFeatures::Zero(2, 3), {}), InputError);
}

}  // namespace pleat
