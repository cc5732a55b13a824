// A solid that is added to the list of solids (beside this file) and named nowhere else: contact
// and the section of scene files are compiled with that list.
#include <catch2/catch.hpp>
#include <memory>
#include <set>
#include <string>

#include "core/contact/contact_pass.h"
#include "core/scene/format/solid_section.h"
#include "native-tests/support/places.h"

namespace pleat {
namespace {

const VertexId kVertex{0};
constexpr double kHalfThickness = 0.01;  // half of the cloth's thickness [m]

/// Its upper side is at y = 0.
ContactPass shelf_pass(const Motion& motion) {
  ContactOptions options;
  options.half_thickness = kHalfThickness;
  const Collider limb{RoundedCone{{5, 0, 0}, {6, 0, 0}, 0.2, 0.1}, {}, 0};
  return ContactPass({limb, Collider{Shelf{-0.1, 0.1}, motion, 0}}, options);
}

Motion held() { return {}; }

Motion lifted() {
  Motion motion;
  motion.kind = Motion::Kind::move;
  motion.offset = {0, 0.05, 0};
  motion.time_end = 1;
  return motion;
}

}  // namespace

TEST_CASE("made-up solid: contact keeps a vertex off it, held and lifted", "[contact]") {
  const auto [motion, rise] = GENERATE(table<Motion, double>({{held(), 0}, {lifted(), 0.05}}));
  const double side = GENERATE(1.0, -1.0);
  CAPTURE(rise, side);
  ContactPass pass = shelf_pass(motion);
  pass.begin_substep(0, 1);
  const double level = -0.1 + rise + side * (0.1 + kHalfThickness);
  Vec3 position(0, -0.1 + side * 0.02, 0);  // not in the middle, which has no side
  Vec3 velocity(1, -side * 2, 0);
  const auto touch = pass.resolve(kVertex, {0, level + side * 0.5, 0}, position, velocity);
  REQUIRE(touch);
  CHECK(touch->normal.isApprox(Vec3(0, side, 0)));
  CHECK(position.y() == Approx(level).margin(1e-12));
  CHECK(pass.gap_at_end(*touch, position).distance == Approx(0).margin(1e-12));
}

TEST_CASE("made-up solid: penetration, support and outline are known of it", "[contact]") {
  ContactPass pass = shelf_pass(held());
  Positions positions(3, 2);
  positions.col(0) << 0, -0.02, 0;
  positions.col(1) << 0, kHalfThickness, 0;
  CHECK(pass.penetration(positions, 0).depth == Approx(0.02));
  CHECK(pass.penetration(positions, 0).n_inside == 1);
  CHECK(pass.supports(positions, 0).size() == 2);
  pass.begin_substep(0, 1);
  std::vector<ContactPass::Outline> outlines;
  pass.outlines(outlines);
  REQUIRE(outlines.size() == 2);
  // The pass takes what no lane knows, wherever it may be met: here everywhere.
  CHECK_FALSE(outlines[0].is_exact);
  CHECK(std::isinf(std::get<SweptSphere>(outlines[0].shape).radius));
}

TEST_CASE("made-up solid: numbers that it does not take are refused", "[contact]") {
  CHECK_THROWS_AS(ContactPass({Collider{Shelf{0, 0}, {}, 0}}, {}), ContractError);
}

TEST_CASE("made-up solid: a scene names it by its word", "[scene]") {
  const Json json = {{"shelf", {{"height_m", 0.25}}}};
  const SolidShape shape = read_solid(JsonReader(json));
  REQUIRE(std::holds_alternative<Shelf>(shape));
  CHECK(std::get<Shelf>(shape).height == 0.25);
  CHECK(std::string(word_for(shape)) == "shelf");
  CHECK(json_solid(shape) == json["shelf"]);
  const Json none = Json::object();
  CHECK_THROWS_WITH(read_solid(JsonReader(none)), Catch::Contains("shelf"));
}

TEST_CASE("made-up solid: a real one is named in eight places", "[contact]") {
  const std::set<std::string> places = {
      "core/base/shapes",                     // its numbers
      "core/contact/solid_shape",             // the list of solids
      "core/contact/swept_contact",           // its meeting with a vertex
      "core/scene/format/solid_section",      // its keys
      "core/scene/scene_schema.json",         // schema of its keys
      "docs/methods/contact.md",              // the formula of its meeting
      "web/src/shared/bindings/geometry.ts",  // its type on the page
      "web/src/shared/stage/solid-look.ts",
  };
  std::set<std::string> named = files_naming({"Plane", "SweptPlane", "'plane'", "\"plane\""});
  // Speed alone asks which solid it is there: the made-up one does without.
  CHECK(named.erase("core/contact/contact_pass") == 1);
  CHECK(named.erase("core/dynamics/position_based/lanes/contact_program") == 1);
  // Other planes than the solid.
  CHECK(named.erase("core/scene/tearing") == 1);
  CHECK(named.erase("web/src/shared/stage/grab.ts") == 1);
  CHECK(named == places);
  tell_places("collider", named.size());
}

}  // namespace pleat
