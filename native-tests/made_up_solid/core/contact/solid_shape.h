// Stands in for the list of solids: it names one more, with all that a solid has to have.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "core/base/check.h"
#include "core/contact/swept_cone.h"
#include "core/contact/swept_contact.h"
#include "core/files/json_reader.h"

namespace pleat {

/// A shelf without end, which keeps level.
struct Shelf {
  double height = 0;          ///< height of its middle [m]
  double half_thickness = 1;  ///< [m], positive
};

struct SweptShelf {
  double height, half_thickness;  ///< [m]
  Vec3 shift;                     ///< [m]
};

inline void validate(const Shelf& shelf) {
  PLEAT_CHECK(shelf.half_thickness > 0, "a shelf's thickness must be positive");
}

inline Shelf placed(const Shelf& shelf, const Pose& pose) {
  return {shelf.height + pose.translation.y(), shelf.half_thickness};
}

inline std::array<double, 2> end_radii(const Shelf& /*shelf*/) {
  constexpr double kFlat = std::numeric_limits<double>::infinity();
  return {kFlat, kFlat};
}

inline Sphere ball_around(const Shelf& shelf) {
  return {{0, shelf.height, 0}, std::numeric_limits<double>::infinity()};
}

inline SweptShelf swept(const Shelf& shelf, const Clearance& clearance, const Vec3& shift) {
  return {shelf.height, shelf.half_thickness + clearance.at_a, shift};
}

inline void shrink(SweptShelf& shelf, const Clearance& inset) {
  shelf.half_thickness -= inset.at_a;
}

inline Gap gap(const SweptShelf& shelf, const Vec3& place) {
  const double above = place.y() - shelf.height;
  return {std::abs(above) - shelf.half_thickness, {0, above < 0 ? -1.0 : 1.0, 0}};
}

inline std::optional<Impact> first_impact(const SweptShelf& shelf, const Vec3& begin,
                                          const Vec3& end, double slack) {
  const Vec3 start = begin + shelf.shift;
  const Gap from = gap(shelf, start);
  const double level = shelf.height + from.normal.y() * shelf.half_thickness;
  const double below = from.normal.y() * (level - end.y()) - slack;
  if (!(below > 0)) return std::nullopt;
  const double above = std::max(from.distance, 0.0);
  const double fraction = above / (above + below);
  Vec3 point = start + fraction * (end - start);
  point.y() = level;
  return Impact{fraction, from.normal, point};
}

struct ShelfForm {
  const char* word;
  void (*read)(const JsonReader& reader, Shelf& shelf);
  Json (*json)(const Shelf& shelf);
};

inline ShelfForm form_of(const Shelf& /*shelf*/) {
  return {"shelf",
          [](const JsonReader& reader, Shelf& shelf) {
            reader.allow_keys({"height_m"});
            shelf.height = reader.at("height_m").number();
          },
          [](const Shelf& shelf) {
            return Json{{"height_m", shelf.height}};
          }};
}

using SolidShape = std::variant<Plane, Sphere, RoundedCone, Shelf>;

}  // namespace pleat
