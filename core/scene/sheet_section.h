#pragma once

#include <string>
#include <vector>

#include "core/files/json_reader.h"
#include "core/mesh/quad_mesh.h"
#include "core/mesh/vertex_group.h"

namespace pleat {

/// How a kind of flat rectangular cloth calls what a SheetShape holds.
struct SheetWords {
  const char* warp_direction;
  const char* weft_direction;
  int border;  ///< 0 where "columns" and "rows" are of cells, 1 where they are of particles
};

/// Size, counts, place and directions. What the scene leaves out stays as it is in `shape`.
void read_sheet_shape(const JsonReader& reader, const SheetWords& words, SheetShape& shape);

/// Object with the keys of the shape, in the form of write_scene.
Json json_sheet_shape(const SheetWords& words, const SheetShape& shape);

/// Edges and corners by name, of any refinement (2 x n [m]): upper is u = 0 (where warp begins),
/// left is v = 0 (where weft begins).
std::vector<VertexGroup> sheet_part_groups(const SheetShape& shape, const RestCoordinates& uv);

/// The name of an edge or a corner. Throws InputError for any other.
std::string read_sheet_part(const JsonReader& reader);

/// The unrefined vertices of a part that read_sheet_part returned, ascending.
std::vector<VertexId> sheet_part(const SheetShape& shape, const std::string& name);

}  // namespace pleat
