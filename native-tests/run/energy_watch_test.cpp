#include "core/run/energy_watch.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/scene/format/scene_file.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

Scene scene_to_bound(const Json& json) { return read_scene(JsonReader(json), fabric_library()); }

/// A mass of 0.1 kg half a metre below its pin, on a spring of 100 N/m.
Json hung_bob() {
  return parse_json(R"({"pins": [{"vertices": [0]}], "cloth": {"particles": {
      "positions_m": [[0, 1.5, 0], [0, 1, 0]], "masses_kg": [0.1, 0.1],
      "springs": [{"a": 0, "b": 1, "stiffness_n_per_m": 100, "rest_length_m": 0.5}]}}})");
}

/// A square of linen of 0.4 m that lies at a height of 1 m.
Json lying_linen() {
  return parse_json(R"({"fabric": {"name": "linen"}, "cloth": {"sheet": {
      "width_m": 0.4, "height_m": 0.4, "columns": 4, "rows": 4, "origin_m": [0, 1, 0],
      "warp_direction": [0, 0, 1], "weft_direction": [1, 0, 0]}}})");
}

bool bounds_energy(const Json& json) {
  const Simulation simulation(scene_to_bound(json));
  return EnergyWatch(simulation).is_bounded(simulation);
}

}  // namespace

TEST_CASE("energy_watch: a spring stores k d^2/2 of m g h, and of the bob's speed at the start",
          "[run]") {
  const double speed = GENERATE(0.0, 0.7);  // [m/s]
  Simulation simulation(scene_to_bound(hung_bob()));
  State state = simulation.state();
  state.velocities(0, 1) = speed;
  simulation.go_on_from(state, 0);
  const EnergyWatch watch(simulation);
  state.positions(1, 1) -= 0.03;
  simulation.go_on_from(state, 0);
  const EnergyWatch::Look look = watch.look(simulation);
  CHECK(look.stored == Approx(100 * 0.03 * 0.03 / 2));
  CHECK(look.available == Approx(0.1 * (9.81 * 0.03 + speed * speed / 2)));
}

// Diagonals bear a hundredth of it, and turn.
TEST_CASE("energy_watch: a sheet that is stretched alike stores K e^2/2 of its area", "[run]") {
  const double strain = GENERATE(1e-3, 0.05);
  constexpr double kSize = 0.4;   // [m]
  constexpr double kFall = 0.25;  // [m]
  Simulation simulation(scene_to_bound(lying_linen()));
  const EnergyWatch watch(simulation);
  State state = simulation.state();
  state.positions.row(2) *= 1 + strain;
  state.positions.row(1).array() -= kFall;
  simulation.go_on_from(state, 0);
  const FabricConstants& linen = simulation.scene().fabric;
  const EnergyWatch::Look look = watch.look(simulation);
  CHECK(look.stored ==
        Approx(linen.stretch_warp * strain * strain / 2 * kSize * kSize).epsilon(1e-3));
  CHECK(look.available == Approx(linen.areal_density * kSize * kSize * 9.81 * kFall));
}

// An undamped pendulum turns all of its fall into stretch where it turns round.
TEST_CASE("energy_watch: a spring at its lowest has all of its fall, which is explained", "[run]") {
  Json json = hung_bob();
  json["method"] = {{"stepper", "rk4"}};
  Simulation simulation(scene_to_bound(json));
  const EnergyWatch watch(simulation);
  double most = 0;
  double least_share = 10;
  while (simulation.time() < 0.4) {
    REQUIRE(simulation.step().ok());
    const EnergyWatch::Look look = watch.look(simulation);
    most = std::max(most, look.stored / look.available);
    least_share = std::min(least_share, watch.explained_share(simulation));
  }
  CHECK(most == Approx(1).epsilon(1e-3));
  CHECK(least_share > 1);
  CHECK(least_share < 1.5);
}

TEST_CASE("energy_watch: what moves or blows works on cloth, and bounds no energy", "[run]") {
  CHECK(bounds_energy(hung_bob()));
  Json json = lying_linen();
  json["world"] = parse_json(R"({"air": {}, "colliders": [{"plane": {}}]})");
  CHECK(bounds_energy(json));
  const auto with = [&](const char* pointer, const char* value) {
    Json other = json;
    other[Json::json_pointer(pointer)] = parse_json(value);
    return bounds_energy(other);
  };
  const char* const motion =
      GENERATE(R"({"kind": "ease", "offset_m": [0, 0, 1], "begin_s": 1, "end_s": 2})",
               R"({"kind": "turn", "axis": [0, 1, 0], "rad_per_s": 3, "begin_s": 1, "end_s": 2})");
  CHECK_FALSE(with("/world/air", R"({"wind": {"velocity_m_per_s": [0, 0, 1]}})"));
  CHECK_FALSE(with("/world/colliders/0/motion", motion));
  CHECK_FALSE(with("/cloth/sheet/origin_m", "[0, -0.1, 0]"));
  json["pins"] = parse_json(R"([{"part": "upper_edge"}])");
  CHECK(bounds_energy(json));
  CHECK_FALSE(with("/pins/0/motion", motion));
}

TEST_CASE("energy_watch: a hand works on cloth", "[run]") {
  Simulation simulation(scene_to_bound(lying_linen()));
  const EnergyWatch watch(simulation);
  CHECK(watch.is_bounded(simulation));
  simulation.grab(VertexId(3));
  CHECK_FALSE(watch.is_bounded(simulation));
  CHECK(std::isinf(watch.explained_share(simulation)));
}

}  // namespace pleat
