#include "core/scene/sheet_cloth.h"

namespace pleat {
namespace {

constexpr SheetWords kSheetWords{"warp_direction", "weft_direction", 0};

}  // namespace

Json SheetCloth::json() const {
  Json json = json_sheet_shape(kSheetWords, shape);
  json["initial_velocity_m_per_s"] = json_vec3(initial_velocity);
  return json;
}

std::int64_t SheetCloth::n_vertices(int level) const {
  const std::int64_t cells_per_side = std::int64_t{1} << level;
  return (shape.columns * cells_per_side + 1) * (shape.rows * cells_per_side + 1);
}

RestCloth SheetCloth::at_rest(QuadMesh quads) const {
  RestCloth cloth = flat_rest_cloth(std::move(quads));
  cloth.start_velocities = initial_velocity.replicate(1, cloth.start.cols());
  cloth.groups = sheet_part_groups(shape, cloth.rest_coordinates);
  return cloth;
}

SheetCloth read_sheet(const JsonReader& reader) {
  reader.allow_keys({"width_m", "height_m", "columns", "rows", "origin_m", "warp_direction",
                     "weft_direction", "initial_velocity_m_per_s"});
  SheetCloth cloth;
  read_sheet_shape(reader, kSheetWords, cloth.shape);
  if (const auto at = reader.find("initial_velocity_m_per_s")) cloth.initial_velocity = at->vec3();
  return cloth;
}

}  // namespace pleat
