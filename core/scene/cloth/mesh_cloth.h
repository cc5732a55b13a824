#pragma once

#include <optional>

#include "core/scene/cloth_source.h"
#include "core/scene/vertex_place.h"

namespace pleat {

/// Any triangle mesh, at rest at time 0. Its parts are its groups.
class MeshCloth final : public ClothSource {
 public:
  TriangleMesh mesh;                    ///< sound (mesh_fault), with all warp directions
  std::vector<VertexGroup> groups;      ///< groups with different names, none empty
  RestCoordinates texture_coordinates;  ///< 2 x n; empty unless each vertex has exactly one pair
  std::vector<std::optional<CornerTexture>> textures;  ///< one per triangle
  Vec3 initial_velocity{0, 0, 0};                      ///< [m/s]
  std::string skipped;  ///< skipped statements of its file (skipped_sentence)

  const char* key() const override { return "mesh"; }
  /// Always written out, so that the text is the whole scene.
  Json json() const override;
  std::string remark() const override { return skipped; }
  std::int64_t n_vertices(int level) const override;
  RestCloth at_rest(int level) const override;
  double rest_diagonal() const override {
    return mesh.rest_positions.cols() == 0 ? 0 : box_diagonal(mesh.rest_positions);
  }
  std::string read_part(const JsonReader& reader) const override {
    return read_group(reader, groups).name;
  }
  std::vector<VertexId> base_part(const std::string& name) const override {
    return vertices_of(groups, name);
  }
};

/// The key "initial_velocity_m_per_s" [m/s]; rest without it.
Vec3 read_initial_velocity(const JsonReader& reader);

/// The section "mesh" of a scene's cloth where the mesh is written out.
///
/// Warp runs along the direction in which the first texture coordinate grows while the second
/// stays. Where a triangle has no texture coordinates, or they have no area, it is the direction
/// nearest to "warp_direction" in its plane, or its first side where that is perpendicular to it.
/// Lengths are those of the positions, or with "rest": "texture" those of the flat pattern that the
/// texture coordinates are, times "texture_scale_m"; then every face needs them, with an area and
/// wound like the face.
///
/// usual_warp  takes the place of a "warp_direction" that is not there
MeshCloth read_written_mesh(const JsonReader& reader,
                            const std::optional<Vec3>& usual_warp = std::nullopt);

}  // namespace pleat
