#include "core/scene/sheet_cloth.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace pleat {
namespace {

constexpr std::int64_t kMaxCells = kMaxVertices;  // along one side; the product is checked too

/// The sides of a sheet that a part lies on: one for an edge, two for a corner.
struct SheetSides {
  bool upper, lower, left, right;
};

constexpr std::array<Word<SheetSides>, 8> kSheetParts{
    {{"upper_edge", {true, false, false, false}},
     {"lower_edge", {false, true, false, false}},
     {"left_edge", {false, false, true, false}},
     {"right_edge", {false, false, false, true}},
     {"upper_left", {true, false, true, false}},
     {"upper_right", {true, false, false, true}},
     {"lower_left", {false, true, true, false}},
     {"lower_right", {false, true, false, true}}}};

/// True when a vertex at (u, v) lies on these sides of a sheet. Refinement takes exact means of
/// the borders' coordinates, so they compare equal.
bool is_on(const SheetSides& sides, const SheetShape& shape, double u, double v) {
  return (!sides.upper || u == 0) && (!sides.lower || u == shape.height) &&
         (!sides.left || v == 0) && (!sides.right || v == shape.width);
}

VertexGroup part_group(const Word<SheetSides>& part, const SheetShape& shape,
                       const RestCoordinates& uv) {
  VertexGroup group{part.text, {}};
  for (Eigen::Index i = 0; i < uv.cols(); ++i)
    if (is_on(part.value, shape, uv(0, i), uv(1, i))) group.vertices.emplace_back(i);
  return group;
}

/// Directions that are perpendicular up to the digits of a file are made so to the last bit.
void read_directions(const JsonReader& reader, SheetShape& shape) {
  constexpr double kWrittenDigits = 1e-6;  // cosine; a file with six digits is meant perpendicular
  constexpr double kRoundedDigits =
      1e-14;  // cosine; kept to the bit, so that what was written is read back
  if (const auto at = reader.find("warp_direction")) shape.warp_direction = at->direction();
  if (const auto at = reader.find("weft_direction")) shape.weft_direction = at->direction();
  const double cosine = shape.warp_direction.dot(shape.weft_direction);
  if (std::abs(cosine) > kWrittenDigits)
    throw InputError(reader.pointer() + "/weft_direction",
                     "expected a direction perpendicular to warp_direction, got one at " +
                         Json(std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / M_PI).dump() +
                         " degrees");
  if (std::abs(cosine) > kRoundedDigits)
    shape.weft_direction = (shape.weft_direction - cosine * shape.warp_direction).normalized();
}

}  // namespace

const char* SheetCloth::key() const { return "sheet"; }

// Key by key, as write_scene does.
Json SheetCloth::json() const {
  Json json;
  json["width_m"] = shape.width;
  json["height_m"] = shape.height;
  json["columns"] = shape.columns;
  json["rows"] = shape.rows;
  json["origin_m"] = json_vec3(shape.origin);
  json["warp_direction"] = json_vec3(shape.warp_direction);
  json["weft_direction"] = json_vec3(shape.weft_direction);
  json["initial_velocity_m_per_s"] = json_vec3(initial_velocity);
  return json;
}

std::int64_t SheetCloth::n_vertices(int level) const {
  const std::int64_t cells_per_side = std::int64_t{1} << level;
  return (shape.columns * cells_per_side + 1) * (shape.rows * cells_per_side + 1);
}

double SheetCloth::rest_diagonal() const { return std::hypot(shape.width, shape.height); }

QuadMesh SheetCloth::base_quads() const { return QuadMesh::sheet(shape); }

RestCloth SheetCloth::at_rest(QuadMesh quads) const {
  RestCloth cloth = flat_rest_cloth(std::move(quads));
  cloth.start_velocities = initial_velocity.replicate(1, cloth.start.cols());
  for (const Word<SheetSides>& part : kSheetParts)
    cloth.groups.push_back(part_group(part, shape, cloth.rest_coordinates));
  return cloth;
}

std::string SheetCloth::read_part(const JsonReader& reader) const {
  reader.word(kSheetParts);
  return reader.text();
}

/// Rows r and columns c of the vertex grid, so that a large mesh need not be made.
std::vector<VertexId> SheetCloth::base_part(const std::string& name) const {
  const auto* const part = std::find_if(kSheetParts.begin(), kSheetParts.end(),
                                        [&](const auto& word) { return name == word.text; });
  PLEAT_CHECK(part != kSheetParts.end(), "a sheet has the part that a pin names");
  const auto [upper, lower, left, right] = part->value;
  std::vector<VertexId> vertices;
  for (int r = lower ? shape.rows : 0; r <= (upper ? 0 : shape.rows); ++r)
    for (int c = right ? shape.columns : 0; c <= (left ? 0 : shape.columns); ++c)
      vertices.emplace_back(std::int64_t{r} * (shape.columns + 1) + c);
  return vertices;
}

SheetCloth read_sheet(const JsonReader& reader) {
  reader.allow_keys({"width_m", "height_m", "columns", "rows", "origin_m", "warp_direction",
                     "weft_direction", "initial_velocity_m_per_s"});
  SheetCloth cloth;
  SheetShape& shape = cloth.shape;
  if (const auto at = reader.find("width_m")) shape.width = at->number(kPositive);
  if (const auto at = reader.find("height_m")) shape.height = at->number(kPositive);
  if (const auto at = reader.find("columns"))
    shape.columns = static_cast<int>(at->integer(1, kMaxCells));
  if (const auto at = reader.find("rows")) shape.rows = static_cast<int>(at->integer(1, kMaxCells));
  if (const auto at = reader.find("origin_m")) shape.origin = at->vec3();
  read_directions(reader, shape);
  if (const auto at = reader.find("initial_velocity_m_per_s")) cloth.initial_velocity = at->vec3();
  const std::int64_t n_vertices = cloth.n_vertices(0);
  if (n_vertices > kMaxVertices)
    throw InputError(reader.pointer(), "expected at most " + std::to_string(kMaxVertices) +
                                           " vertices, got " + std::to_string(n_vertices));
  return cloth;
}

}  // namespace pleat
