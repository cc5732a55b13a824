#include "core/hard_cases/case_checks.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/scene/format/scene_file.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/small_scene.h"

namespace pleat {
namespace {

constexpr double kStep = 0.01;  // [s]

/// A sheet of nine vertices, 1 m x 1 m, upright about the y axis, by `explicit`, which makes no
/// error in what only drifts or falls.
Json sheet_scene() {
  return parse_json(R"({
    "cloth": {"sheet": {"columns": 2, "rows": 2, "origin_m": [-0.5, 0, 0]}},
    "fabric": {"areal_density_kg_per_m2": 0.1},
    "world": {"gravity_m_per_s2": [0, 0, 0]},
    "method": {"stepper": "explicit", "step_s": 0.01}})");
}

Json drifting(const Vec3& velocity) {
  Json json = sheet_scene();
  json["cloth"]["sheet"]["initial_velocity_m_per_s"] = json_vec3(velocity);
  return json;
}

Json falling() {
  Json json = sheet_scene();
  json["world"]["gravity_m_per_s2"] = {0, -10, 0};
  return json;
}

/// Its side edges are pinned, and the right one moves this far in the first second.
Json pulled(const Vec3& offset) {
  Json json = sheet_scene();
  json["pins"] = {{{"part", "left_edge"}},
                  {{"part", "right_edge"},
                   {"motion", {{"kind", "move"}, {"offset_m", json_vec3(offset)}, {"end_s", 1}}}}};
  return json;
}

Scene scene_of(const Json& json) { return read_scene(JsonReader(json), fabric_library()); }

/// Value of the check's measure after this time [s].
double found(const CaseCheck& check, const Json& json, double duration) {
  Simulation simulation(scene_of(json));
  const auto measure = check.measure(simulation, duration);
  measure->update(simulation, {});
  while (simulation.n_steps() < std::lround(duration / kStep)) {
    const SolveReport report = simulation.step();
    measure->update(simulation, report);
  }
  return measure->value();
}

/// Difference of two sheets after this time [s], by the check.
double difference(const VariantCheck& check, const Json& a, const Json& b, double duration) {
  std::vector<std::unique_ptr<Simulation>> ends;
  for (const Json& json : {a, b}) {
    ends.push_back(std::make_unique<Simulation>(scene_of(json)));
    while (ends.back()->n_steps() < std::lround(duration / kStep)) ends.back()->step();
  }
  return check.difference(ends);
}

}  // namespace

TEST_CASE("case checks: the distance from the origin is the largest that any vertex ever had",
          "[hard_cases]") {
  CHECK(found(stays_within(1), sheet_scene(), 0.1) == Approx(std::hypot(0.5, 1)));
  CHECK(found(stays_within(1), drifting({0, 1, 0}), 1) == Approx(std::hypot(0.5, 1)));
  CHECK(found(stays_within(1), drifting({0, 3, 0}), 1) == Approx(std::hypot(0.5, 3)));
}

TEST_CASE("case checks: strain is the largest at any time, or that at the end", "[hard_cases]") {
  Json away = pulled({0.2, 0, 0});
  away["cloth"]["sheet"]["columns"] = 1;  // so that all is pinned
  Json back = away;
  back["pins"][1]["motion"] = {
      {"kind", "oscillate"}, {"offset_m", {0.2, 0, 0}}, {"frequency_hz", 1}};
  CHECK(found(strain_at_most(1), away, 2) == Approx(0.2));
  CHECK(found(end_strain_at_most(1), away, 2) == Approx(0.2));
  CHECK(found(strain_at_most(1), back, 1) == Approx(0.2));
  CHECK(found(end_strain_at_most(1), back, 1) < 1e-9);
  CHECK(found(strain_at_most(1), sheet_scene(), 1) == 0);
}

TEST_CASE("case checks: what drifts does not rest, and counts from the window on", "[hard_cases]") {
  CHECK(found(rests(1, 0.1), drifting({0.3, 0, 0}), 2) == Approx(0.3));
  CHECK(found(rests(0.5, 0.1), drifting({0.3, 0, 0}), 2) == Approx(0.15));
  CHECK(found(rests(1, 0.1), sheet_scene(), 2) == 0);
  Json stops = pulled({0.2, 0, 0});
  stops["fabric"]["damping_ratio"] = 1;
  CHECK(found(rests(1, 0.1), stops, 3) < 1e-3);
  CHECK(found(rests(2.5, 0.1), stops, 3) > 0.09);
}

TEST_CASE("case checks: energy that only turns from one kind into another does not grow",
          "[hard_cases]") {
  Json pumped = pulled({0, 0, 0});
  pumped["fabric"]["damping_ratio"] = 0.5;
  pumped["cloth"]["sheet"]["initial_velocity_m_per_s"] = {0, 0, 1};
  CHECK(found(energy_grows_at_most(1), pumped, 1) < 0.1);
  pumped["pins"][1]["motion"] = {
      {"kind", "oscillate"}, {"offset_m", {0.1, 0, 0}}, {"frequency_hz", 2}, {"begin_s", 0.5}};
  CHECK(found(energy_grows_at_most(1), pumped, 1) > 0.5);
}

TEST_CASE("case checks: asymmetry is the distance from the mirror image in diagonals",
          "[hard_cases]") {
  const double diagonal = std::sqrt(2.0);
  CHECK(found(stays_symmetric(1), falling(), 0.5) == 0);
  CHECK(found(stays_symmetric(1), drifting({0.1, 5, 0}), 1) == Approx(0.2 / diagonal));
  CHECK(found(stays_symmetric(1), pulled({0, 0, 0.3}), 1) >= 0.3 / diagonal * (1 - 1e-9));
}

TEST_CASE("case checks: momentum is kept by what drifts and not by what falls", "[hard_cases]") {
  Json json = drifting({2, 0, 0});
  CHECK(found(momentum_kept(1), json, 1) < 1e-12);
  json["world"]["gravity_m_per_s2"] = {0, -10, 0};
  CHECK(found(momentum_kept(1), json, 1) == Approx(10.0 / 2));
}

TEST_CASE("case checks: angular momentum is kept by what turns and not by what is braked",
          "[hard_cases]") {
  const std::string turning = repository_file("assets/hard_cases/tumbling.json");
  Json json = parse_json(turning);
  json["method"] = {{"stepper", "explicit"}, {"step_s", kStep}};
  CHECK(found(angular_momentum_kept(1), json, 1) < 1e-9);
  json["pins"] = {{{"vertices", {0}}}};
  CHECK(found(angular_momentum_kept(1), json, 1) > 0.01);
}

TEST_CASE("case checks: cloth that was pulled too far has torn, and weighs what it weighed",
          "[hard_cases]") {
  Json weak = pulled({0.8, 0, 0});
  weak["model"]["tearing"] = {{"breaking_elongation", 0.2}};
  CHECK(found(tears(), weak, 0.1) == 1);
  CHECK(found(tears(), weak, 1) == 0);
  CHECK(found(mass_kept(0), weak, 1) < 1e-12);
  Json heavy = sheet_scene();
  heavy["fabric"]["areal_density_kg_per_m2"] = 0.15;
  const Simulation light(scene_of(sheet_scene()));
  const auto measure = mass_kept(0).measure(light, 1);
  measure->update(Simulation(scene_of(heavy)), {});
  CHECK(measure->value() == Approx(0.5));
}

TEST_CASE("case checks: a vertex that is held in a ball is as deep as it is", "[hard_cases]") {
  Json json = pulled({0, 0, 0});
  json["world"]["colliders"] = {{{"sphere", {{"centre_m", {-0.5, 0, 0.2}}, {"radius_m", 0.3}}}}};
  CHECK(found(outside_solids(0), json, 0.1) == Approx(0.1));
  CHECK(found(outside_solids(0), sheet_scene(), 0.1) == 0);
}

// The lower half is turned up in front of the sheet, and its last row of cells goes through it.
TEST_CASE("case checks: edges that go through cloth are counted at any time", "[hard_cases]") {
  CHECK(no_crossings().bound == 0);
  CHECK(found(no_crossings(), drifting({0, 3, 0}), 0.1) == 0);
  Json json = sheet_scene();
  json["cloth"]["sheet"]["rows"] = 4;
  json["start"]["positions_m"] = Json::array();
  for (const double y : {1.0, 0.5, 0.0, 0.4, 0.8})
    for (const double x : {-0.5, 0.0, 0.5})
      json["start"]["positions_m"].push_back({x, y, y == 0.4 ? 0.1 : y == 0.8 ? -0.1 : 0.0});
  const double crossings = found(no_crossings(), json, 0.01);
  CHECK(crossings > 0);
  CHECK(crossings == std::round(crossings));
}

TEST_CASE("case checks: a velocity jumps by what a step changes it", "[hard_cases]") {
  CHECK(found(velocity_jumps_at_most(1), falling(), 0.5) == Approx(10 * kStep));
  CHECK(found(velocity_jumps_at_most(1), drifting({9, 0, 0}), 0.5) < 1e-9);
}

TEST_CASE("case checks: nonsense is counted and told, and cloth that hangs shows none",
          "[hard_cases]") {
  CHECK(found(no_nonsense(), parse_json(kSmallScene), 0.2) == 0);
  Json json = sheet_scene();
  json["pins"] = {{{"part", "upper_edge"}}};
  json["world"]["gravity_m_per_s2"] = {0, -1e6, 0};
  json["method"] = {{"stepper", "implicit"}, {"step_s", kStep}};
  CHECK(found(no_nonsense(), json, 0.2) > 0);
  CHECK(found(speeds_explained(), json, 0.2) == 0);
  CHECK(found(speeds_explained(), parse_json(kWildScene), 0.02) == 1);
}

TEST_CASE("case checks: variants are compared about their own places and in their own sizes",
          "[hard_cases]") {
  Json away = drifting({0, 0, 1});
  away["cloth"]["sheet"]["origin_m"] = {100, 200, 300};
  CHECK(difference(variants_agree(1), drifting({0, 0, 1}), away, 1) < 1e-12);
  Json twice = drifting({0, 0, 2});
  for (const char* side : {"width_m", "height_m"}) twice["cloth"]["sheet"][side] = 2;
  CHECK(difference(variants_agree(1), drifting({0, 0, 1}), twice, 1) < 1e-12);
  CHECK(difference(variants_agree(1), drifting({0, 0, 1}), drifting({0, 0, 1.5}), 1) ==
        Approx(0.5 / std::sqrt(2.0)));
}

TEST_CASE("case checks: sags are compared by how much longer the cloth hangs than it rests",
          "[hard_cases]") {
  const auto lowered = [](double way) {
    Json json = sheet_scene();
    const Json motion = {{"kind", "move"}, {"offset_m", {0, -way, 0}}, {"end_s", 1}};
    json["pins"] = {{{"part", "upper_edge"}}, {{"part", "lower_edge"}, {"motion", motion}}};
    return json;
  };
  CHECK(difference(sags_agree(1), lowered(0.1), lowered(0.1), 1) == 0);
  CHECK(difference(sags_agree(1), lowered(0.1), lowered(0.15), 1) == Approx(0.5));
}

}  // namespace pleat
