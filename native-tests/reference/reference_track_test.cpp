#include "core/reference/reference_track.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "native-tests/support/cloth.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

Scene swinging_sheet_scene(int level) {
  Scene scene = released_sheet_scene(3, "fine cotton");
  scene.level = level;
  scene.method.solver = SolverKind::eigen;
  return scene;
}

Reference run_of(const Scene& scene, int n_steps) {
  Simulation simulation(scene);
  Reference reference{{"made-1", "by hand", true}, {}};
  reference.content = content_id(scene);
  for (int s = 0; s < n_steps; ++s) {
    REQUIRE(simulation.step().ok());
    reference.samples.push_back({simulation.time(), simulation.state().positions, {}, 0.001});
  }
  return reference;
}

}  // namespace

TEST_CASE("reference_track: a run is at no distance from itself until it ends", "[reference]") {
  const Scene scene = swinging_sheet_scene(1);
  ReferenceTrack track(run_of(scene, 5));
  Simulation simulation(scene);
  for (int s = 0; s < 5; ++s) {
    REQUIRE(simulation.step().ok());
    const auto distance = track.distance(simulation);
    REQUIRE(distance);
    CHECK(distance->rms < 1e-15);
    CHECK(distance->uncertainty == 0.001);
  }
  REQUIRE(simulation.step().ok());
  CHECK_FALSE(track.distance(simulation));
  CHECK(track.distances().empty());
}

TEST_CASE("reference_track: distances are those of each vertex", "[reference]") {
  const Scene scene = swinging_sheet_scene(1);
  Reference reference = run_of(scene, 1);
  reference.samples[0].positions.col(7) += Vec3(0, 0.25, 0);
  ReferenceTrack track(reference);
  Simulation simulation(scene);
  REQUIRE(simulation.step().ok());
  const auto distance = track.distance(simulation);
  REQUIRE(distance);
  for (std::size_t i = 0; i < track.distances().size(); ++i)
    CHECK(track.distances()[i] == Approx(i == 7 ? 0.25 : 0).margin(1e-7));
  const Eigen::VectorXd areas = simulation.rest_areas();
  CHECK(distance->rms == Approx(0.25 * std::sqrt(areas[7] / areas.sum())));
}

TEST_CASE("reference_track: coarser and finer cloth is compared along the mesh", "[reference]") {
  Reference reference{{"made-1", "by hand", true}, {}};
  const Scene scene = swinging_sheet_scene(1);
  Simulation still(scene);
  reference.samples.push_back({1, still.rest_positions(), {}});
  ReferenceTrack track(reference);
  for (const int level : {0, 1, 2}) {
    CAPTURE(level);
    Scene other = swinging_sheet_scene(level);
    other.gravity.setZero();
    Simulation simulation(other);
    REQUIRE(simulation.step().ok());
    const auto distance = track.distance(simulation);
    REQUIRE(distance);
    CHECK(distance->rms < 1e-12);
    CHECK(track.distances().size() == static_cast<std::size_t>(simulation.model().n_vertices()));
  }
}

TEST_CASE("reference_track: cloth that was led astray has no distance", "[reference]") {
  const Scene scene = swinging_sheet_scene(1);
  ReferenceTrack track(run_of(scene, 5));
  Simulation simulation(scene);
  const Positions start = simulation.rest_positions();
  const auto has_distance = [&] {
    const bool has = track.distance(simulation).has_value();
    CHECK(track.distances().empty() == !has);
    return has;
  };
  SECTION("by a hand, until it starts anew") {
    simulation.grab(VertexId(40));
    CHECK_FALSE(has_distance());
    simulation.release_grab();
    CHECK_FALSE(has_distance());
    simulation.reset();
    CHECK(has_distance());
  }
  SECTION("by other places to start from, whenever it starts from them") {
    simulation.start_from(start);
    CHECK_FALSE(has_distance());
    simulation.reset();
    CHECK_FALSE(has_distance());
  }
  SECTION("by another scene's cloth, and not by its own at another level") {
    Scene other = scene;
    other.fabric = library_fabric("silk");
    Simulation of_another(other);
    simulation.carry_over(of_another);
    CHECK_FALSE(has_distance());
    Simulation finer(swinging_sheet_scene(2));
    finer.carry_over(simulation);
    CHECK(finer.is_disturbed());
    Simulation undisturbed(swinging_sheet_scene(2));
    undisturbed.carry_over(Simulation(scene));
    CHECK(track.distance(undisturbed));
  }
}

TEST_CASE("reference_track: level, method, name and duration are not its content", "[reference]") {
  const Scene scene = swinging_sheet_scene(1);
  Scene other = scene;
  other.level = 3;
  other.method.stepper = &steppers::kXpbd;
  other.name = "renamed";
  other.duration = 77;
  CHECK(ReferenceTrack(run_of(scene, 1)).is_of(other));
}

TEST_CASE("reference_track: a changed scene never meets an old reference", "[reference]") {
  const Scene scene = swinging_sheet_scene(1);
  const ReferenceTrack track(run_of(scene, 1));
  const int change = GENERATE(range(0, 7));
  Scene other = scene;
  if (change == 0) other.fabric.bend_warp *= 1 + 1e-12;
  if (change == 1)
    change_cloth<SheetCloth>(other, [](SheetCloth& sheet) { sheet.shape.width *= 1 + 1e-12; });
  if (change == 2) other.model.bending = BendingModel::linear;
  if (change == 3) other.pins[0].motion = {Motion::Kind::move, {0, 1e-9, 0}, 0, 1, 0};
  if (change == 4) other.gravity.y() *= 1 + 1e-12;
  if (change == 5) other.air.emplace();
  if (change == 6) other.colliders.emplace_back();
  CAPTURE(change);
  CHECK_FALSE(track.is_of(other));
}

TEST_CASE("reference_track: a reference without samples is refused", "[reference]") {
  CHECK_THROWS_AS(ReferenceTrack(Reference{{"made-1", "by hand", true}, {}}), InputError);
}

TEST_CASE("reference: 32-bit positions come back to seven digits", "[reference]") {
  const Reference written = run_of(swinging_sheet_scene(0), 2);
  const Reference read = read_reference(write_reference(written, Precision::float32));
  REQUIRE(read.samples.size() == 2);
  CHECK(read.content == written.content);
  CHECK(read.samples[1].uncertainty == 0.001);
  const double error = (read.samples[1].positions - written.samples[1].positions).norm();
  CHECK(error > 0);
  CHECK(error < 1e-6);
}

TEST_CASE("reference: positions that are not finite are refused", "[reference]") {
  Reference written = run_of(swinging_sheet_scene(0), 1);
  written.samples[0].positions(0, 0) = std::nan("");
  CHECK_THROWS_AS(read_reference(write_reference(written)), InputError);
}

}  // namespace pleat
