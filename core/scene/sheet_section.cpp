#include "core/scene/sheet_section.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace pleat {
namespace {

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

}  // namespace

void read_sheet_shape(const JsonReader& reader, const SheetWords& words, SheetShape& shape) {
  const auto read_count = [&](const char* key, int& cells) {
    if (const auto at = reader.find(key))
      cells = static_cast<int>(at->integer(1 + words.border, kMaxVertices)) - words.border;
  };
  if (const auto at = reader.find("width_m")) shape.width = at->number(kPositive);
  if (const auto at = reader.find("height_m")) shape.height = at->number(kPositive);
  read_count("columns", shape.columns);
  read_count("rows", shape.rows);
  if (const auto at = reader.find("origin_m")) shape.origin = at->vec3();
  read_perpendicular(reader, {words.warp_direction, words.weft_direction}, shape.warp_direction,
                     shape.weft_direction);
  const std::int64_t n_vertices = (std::int64_t{shape.columns} + 1) * (shape.rows + 1);
  if (n_vertices > kMaxVertices)
    throw InputError(reader.pointer(), "expected at most " + std::to_string(kMaxVertices) +
                                           " vertices, got " + std::to_string(n_vertices));
}

Json json_sheet_shape(const SheetWords& words, const SheetShape& shape) {
  Json json;
  json["width_m"] = shape.width;
  json["height_m"] = shape.height;
  json["columns"] = shape.columns + words.border;
  json["rows"] = shape.rows + words.border;
  json["origin_m"] = json_vec3(shape.origin);
  json[words.warp_direction] = json_vec3(shape.warp_direction);
  json[words.weft_direction] = json_vec3(shape.weft_direction);
  return json;
}

std::vector<VertexGroup> sheet_part_groups(const SheetShape& shape, const RestCoordinates& uv) {
  std::vector<VertexGroup> groups;
  for (const Word<SheetSides>& part : kSheetParts) {
    groups.push_back({part.text, {}});
    for (Eigen::Index i = 0; i < uv.cols(); ++i)
      if (is_on(part.value, shape, uv(0, i), uv(1, i))) groups.back().vertices.emplace_back(i);
  }
  return groups;
}

std::string read_sheet_part(const JsonReader& reader) {
  reader.word(kSheetParts);
  return reader.text();
}

/// Rows r and columns c of the vertex grid, so that a large mesh need not be made.
std::vector<VertexId> sheet_part(const SheetShape& shape, const std::string& name) {
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

}  // namespace pleat
