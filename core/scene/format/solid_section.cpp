#include "core/scene/format/solid_section.h"

#include <string_view>

#include "core/base/check.h"

namespace pleat {
namespace {

/// How a scene tells of a solid.
template <class Solid>
struct SolidForm {
  const char* word;
  void (*read)(const JsonReader& reader, Solid& solid);
  Json (*json)(const Solid& solid);
};

SolidForm<Plane> form_of(const Plane& /*plane*/) {
  return {"plane",
          [](const JsonReader& reader, Plane& plane) {
            reader.allow_keys({"point_m", "normal"});
            if (const auto at = reader.find("point_m")) plane.point = at->vec3();
            if (const auto at = reader.find("normal")) plane.normal = at->direction();
          },
          [](const Plane& plane) {
            return Json{{"point_m", json_vec3(plane.point)}, {"normal", json_vec3(plane.normal)}};
          }};
}

SolidForm<Sphere> form_of(const Sphere& /*sphere*/) {
  return {"sphere",
          [](const JsonReader& reader, Sphere& sphere) {
            reader.allow_keys({"centre_m", "radius_m"});
            if (const auto at = reader.find("centre_m")) sphere.centre = at->vec3();
            if (const auto at = reader.find("radius_m")) sphere.radius = at->number(kPositive);
          },
          [](const Sphere& sphere) {
            return Json{{"centre_m", json_vec3(sphere.centre)}, {"radius_m", sphere.radius}};
          }};
}

/// Scenes name capsules alone; other rounded cones are limbs of a body.
SolidForm<RoundedCone> form_of(const RoundedCone& /*cone*/) {
  return {"capsule",
          [](const JsonReader& reader, RoundedCone& cone) {
            reader.allow_keys({"a_m", "b_m", "radius_m"});
            if (const auto at = reader.find("a_m")) cone.centre_a = at->vec3();
            if (const auto at = reader.find("b_m")) cone.centre_b = at->vec3();
            if (const auto at = reader.find("radius_m"))
              cone.radius_a = cone.radius_b = at->number(kPositive);
          },
          [](const RoundedCone& cone) {
            PLEAT_CHECK(
                cone.radius_a == cone.radius_b && cone.half_width_a == 0 && cone.half_width_b == 0,
                "a scene names capsules alone of rounded cones");
            return Json{{"a_m", json_vec3(cone.centre_a)},
                        {"b_m", json_vec3(cone.centre_b)},
                        {"radius_m", cone.radius_a}};
          }};
}

/// Calls work(solid, form) for each kind of solid, with its usual numbers.
template <class... Solids, class Work>
void for_each_form(const std::variant<Solids...>& /*any*/, const Work& work) {
  (work(Solids{}, form_of(Solids{})), ...);
}

}  // namespace

std::vector<const char*> solid_words() {
  std::vector<const char*> words;
  for_each_form(SolidShape{},
                [&](const auto& /*solid*/, const auto& form) { words.push_back(form.word); });
  return words;
}

SolidShape read_solid(const JsonReader& collider) {
  const std::vector<const char*> words = solid_words();
  const std::string_view word = words[collider.only_one_of(words)];
  SolidShape found;
  for_each_form(found, [&](auto solid, const auto& form) {
    if (form.word != word) return;
    form.read(collider.at(form.word), solid);
    found = solid;
  });
  return found;
}

const char* word_for(const SolidShape& shape) {
  return std::visit([](const auto& solid) { return form_of(solid).word; }, shape);
}

Json json_solid(const SolidShape& shape) {
  return std::visit([](const auto& solid) { return form_of(solid).json(solid); }, shape);
}

}  // namespace pleat
