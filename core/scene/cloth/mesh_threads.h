#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/files/json_reader.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// The corners of a triangle [m].
using Corners = std::array<Vec3, 3>;
/// Texture coordinates of each triangle of a mesh, where it has them.
using CornerTextures = std::vector<std::optional<CornerTexture>>;
/// Names the place of a triangle in the input.
using TrianglePlace = std::function<std::string(std::size_t triangle)>;

Corners corners_of(const TriangleMesh& mesh, const Triangle& triangle);

/// The direction's part in the plane, of unit length. It is in the plane up to rounding however
/// steep the direction was to it, and zero when that was perpendicular.
Vec3 in_plane(const Vec3& direction, const Corners& corners);

/// Fills in the warp directions from textures, or where a triangle has none from the vector. Throws
/// InputError at the place of a triangle that neither tells of.
void fill_warp_directions(TriangleMesh& mesh, const CornerTextures& textures,
                          const std::optional<Vec3>& vector, const TrianglePlace& place);

/// Throws InputError{place} for a triangle of the pattern that cloth cannot be cut to.
void check_cut(const CornerTexture& corners, const std::string& place);

/// The flat pattern that a mesh's texture coordinates are.
///
/// scale  [m] per unit of the texture
/// Throws InputError at the place of a triangle without any, or that cloth cannot be cut to.
std::vector<CornerTexture> texture_pattern(const CornerTextures& textures, double scale,
                                           const TrianglePlace& place);

/// Rest shape that a mesh asks for.
struct RestChoice {
  bool is_texture = false;
  double scale = 1;  ///< [m] per unit of the texture
};
RestChoice read_rest(const JsonReader& reader);

/// The key "warp_direction", or what is usual where it is not there.
std::optional<Vec3> read_warp_vector(const JsonReader& reader, const std::optional<Vec3>& usual);

}  // namespace pleat
