#include "core/refinement/fit_monitor.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "native-tests/support/bent_sheets.h"

namespace pleat {
namespace {

constexpr int kCells = 16;
constexpr int kFrames = 60;

/// A fold that travels to and fro between 0.15 m and 0.45 m.
double place_at(int frame, double phase) {
  return 0.3 - 0.15 * std::cos(2 * M_PI * frame / kFrames + phase);
}

struct FoldPlan {
  QuadMesh fine;
  RefinementPlan plan;
  QuadMesh mesh;
};

FoldPlan fold_plan() {
  const QuadMesh base = lying_sheet(kCells);
  QuadMesh fine = base;
  fine.refine_uniformly(2);
  BendFeatureSum sum(fine);
  for (int frame = 0; frame < kFrames; ++frame) sum.add(folded(fine, place_at(frame, 0), 1));
  const BendExample example{"fold", sum.features(), bend_patterns(sum.features()), {}};
  RefinementPlan plan = refinement_plan(base, fine, {&example, 1}, by_curvature());
  const QuadMesh mesh = planned_mesh(base, plan);
  ExampleEnvelope envelope(mesh, fine);
  for (int frame = 0; frame < kFrames; ++frame) envelope.add(folded(fine, place_at(frame, 0), 1));
  plan.curvature_limits = envelope.limits();
  return {fine, plan, mesh};
}

FitReport after_motion(const FoldPlan& fold, double amplitude, double offset) {
  FitMonitor monitor(fold.mesh, fold.plan);
  const MeshSample sample(fold.mesh, fold.fine);
  FitReport report;
  for (int frame = 0; frame < kFrames; ++frame)
    report =
        monitor.add_frame(sample.of(folded(fold.fine, offset + place_at(frame, 0.31), amplitude)));
  return report;
}

}  // namespace

TEST_CASE("fit monitor: of the example itself hardly a face is outside", "[refinement]") {
  const FoldPlan fold = fold_plan();
  CHECK(fold.plan.n_vertices < 0.7 * fold.fine.n_vertices());
  const MeshSample sample(fold.mesh, fold.fine);
  const FaceCurvature curvature(fold.mesh);
  REQUIRE(fold.plan.curvature_limits.size() == static_cast<std::size_t>(curvature.n_faces()));
  for (int frame = 0; frame < kFrames; ++frame) {
    const Eigen::VectorXd bends = curvature.of(sample.of(folded(fold.fine, place_at(frame, 0), 1)));
    for (Eigen::Index f = 0; f < bends.size(); ++f)
      CHECK(bends[f] <= fold.plan.curvature_limits[static_cast<std::size_t>(f)]);
  }
  const FitReport report = after_motion(fold, 1, 0);
  CHECK(report.worst_share < 0.05);
  CHECK(!report.first_fired);
  CHECK(report.n_frames == kFrames);
}

TEST_CASE("fit monitor: a smaller fold fits, a larger one or one elsewhere fires", "[refinement]") {
  const FoldPlan fold = fold_plan();
  CHECK(!after_motion(fold, 0.8, 0).first_fired);
  for (const FitReport& report : {after_motion(fold, 1.6, 0), after_motion(fold, 1, 0.4)}) {
    CHECK(report.fires);
    REQUIRE(report.first_fired);
    CHECK(*report.first_fired == FitMonitor::kFrames - 1);
    CHECK(report.worst_share > FitMonitor::kLargestShare);
  }
}

TEST_CASE("fit monitor: nine frames outside do not fire, the tenth does", "[refinement]") {
  const FoldPlan fold = fold_plan();
  FitMonitor monitor(fold.mesh, fold.plan);
  const MeshSample sample(fold.mesh, fold.fine);
  const Positions outside = sample.of(folded(fold.fine, 0.7, 1));
  const Positions inside = sample.of(folded(fold.fine, 0.3, 1));
  for (int frame = 0; frame < 9; ++frame) CHECK(!monitor.add_frame(outside).fires);
  CHECK(monitor.add_frame(inside).n_in_a_row == 0);
  for (int frame = 0; frame < 9; ++frame) CHECK(!monitor.add_frame(outside).fires);
  const FitReport report = monitor.add_frame(outside);
  CHECK(report.fires);
  CHECK(*report.first_fired == 19);
  CHECK(!monitor.add_frame(inside).fires);
}

TEST_CASE("fit monitor: a face may bend as those up to two away from it did", "[refinement]") {
  QuadMesh fine = lying_sheet(kCells);
  const QuadMesh mesh = fine;
  ExampleEnvelope envelope(mesh, fine);
  Positions shape = fine.rest_positions();
  const FaceCurvature curvature(mesh);
  envelope.add(shape);
  shape.row(1) += 0.02 * (fine.rest_positions().row(0).array() < 1e-9).cast<double>().matrix();
  envelope.add(shape);
  const Eigen::VectorXd bends = curvature.of(shape);
  const std::vector<double> limits = envelope.limits();
  // Columns of faces from the edge on: the chords of two bend.
  const auto column = [](Eigen::Index face) { return face % kCells; };
  for (Eigen::Index f = 0; f < bends.size(); ++f) {
    double largest = 0;
    for (Eigen::Index g = 0; g < bends.size(); ++g)
      if (std::abs(column(g) - column(f)) <= 2 && std::abs(g / kCells - f / kCells) <= 2)
        largest = std::max(largest, bends[g]);
    CHECK(limits[static_cast<std::size_t>(f)] >= largest);
    CHECK(limits[static_cast<std::size_t>(f)] < largest + 0.0101);
  }
  CHECK(bends.maxCoeff() > 1);
  CHECK(limits.back() != limits.front());
}

TEST_CASE("fit monitor: faces of a cylinder bend like their corners in the mean", "[refinement]") {
  const QuadMesh mesh = lying_sheet(8);
  const Eigen::VectorXd bends = FaceCurvature(mesh).of(on_cylinder(mesh.rest_positions(), 0, 2));
  // A vertex with all neighbours has (2 + 4/2) / 8 of 1/R; chords of an eighth of R add little.
  CHECK(bends[3 * 8 + 3] == Approx(0.25).epsilon(1e-2));
}

TEST_CASE("fit monitor: a plan without limits is refused", "[refinement]") {
  FoldPlan fold = fold_plan();
  CHECK_THROWS_AS(FitMonitor(fold.fine, fold.plan), ContractError);
  fold.plan.curvature_limits.clear();
  CHECK_THROWS_WITH(FitMonitor(fold.mesh, fold.plan), Catch::Contains("got 0"));
  CHECK_THROWS_AS(ExampleEnvelope(fold.mesh, fold.fine).limits(), ContractError);
}

}  // namespace pleat
