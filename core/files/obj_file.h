#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/mesh/vertex_group.h"

namespace pleat {

/// Statements of one keyword that say nothing to Pleat.
struct SkippedStatements {
  std::string keyword;
  int count = 0;
};

/// A mesh as its OBJ file gives it.
struct ObjMesh {
  Positions positions;                                 ///< [m]
  std::vector<Triangle> triangles;                     ///< sound (mesh_fault)
  std::vector<std::optional<CornerTexture>> textures;  ///< one per triangle
  std::vector<VertexGroup> groups;  ///< groups in the order of their first element
  std::vector<int> lines;           ///< lines of the text, one per triangle: where its face begins
  std::vector<SkippedStatements> skipped;  ///< statements unknown to OBJ, the most frequent first
};

/// Reads Wavefront OBJ: v, vt, f, l, p, g and o. Polygons are split into fans about their first
/// corner and have to be convex enough for that. The vertices of faces (f), lines (l) and points
/// (p) belong to the object (o) and to the groups (g) named last before them; a name that comes
/// again goes on. Further numbers of a vertex (w, colours), normals, smoothing, materials and
/// display attributes are passed over, and so are statements of other programs, which are counted.
///
/// Throws InputError{"line N"} for free-form curves and surfaces, for numbers beyond
/// kLargestNumber, for more than kMaxVertices and for what mesh_fault finds; a text without
/// vertices or faces is refused as a whole, with no line. Source: Wavefront Technologies, Advanced
/// Visualizer manual, appendix B1: object files.
ObjMesh read_obj(std::string_view text);

/// One sentence on what was skipped; empty when nothing was.
std::string skipped_sentence(std::span<const SkippedStatements> skipped);

/// A line of OBJ: a keyword and numbers with the fewest digits that read back to the same bits.
std::string obj_line(const char* keyword, std::span<const double> numbers);

/// The text from which read_obj reads the same mesh, but for the lines. Numbers have the fewest
/// digits that read back to the same bits; a group's vertices are points.
std::string write_obj(const ObjMesh& mesh);

}  // namespace pleat
