#include "core/scene/cloth/obj_cloth.h"

#include <limits>

#include "core/files/obj_file.h"
#include "core/scene/cloth/mesh_threads.h"

namespace pleat {
namespace {

/// One column per vertex; empty where a vertex has none or several.
RestCoordinates vertex_textures(const ObjMesh& obj) {
  RestCoordinates coordinates =
      RestCoordinates::Constant(2, obj.positions.cols(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t f = 0; f < obj.triangles.size(); ++f) {
    if (!obj.textures[f]) return {};
    for (std::size_t k = 0; k < 3; ++k) {
      auto known = coordinates.col(obj.triangles[f][k]);
      const Eigen::Vector2d given = obj.textures[f]->col(static_cast<Eigen::Index>(k));
      if (known.hasNaN()) known = given;
      if (known != given) return {};
    }
  }
  return coordinates;
}

MeshCloth read_obj_mesh(const JsonReader& reader, const FileSource& files,
                        const std::optional<Vec3>& usual_warp) {
  reader.allow_keys(
      {"obj", "rest", "texture_scale_m", "warp_direction", "initial_velocity_m_per_s"});
  const JsonReader at = reader.at("obj");
  at.text();
  if (!files) at.fail("a mesh written out in the scene, as no files can be read here");
  const std::optional<Vec3> vector = read_warp_vector(reader, usual_warp);
  const RestChoice rest = read_rest(reader);
  return read_named_file(at, files, [&](const std::string& text) {
    ObjMesh obj = read_obj(text);
    const TrianglePlace place = [&](std::size_t f) {
      return "line " + std::to_string(obj.lines[f]);
    };
    MeshCloth cloth;
    cloth.texture_coordinates = vertex_textures(obj);
    cloth.mesh.rest_positions = std::move(obj.positions);
    cloth.mesh.triangles = std::move(obj.triangles);
    cloth.groups = std::move(obj.groups);
    if (rest.is_texture) cloth.mesh.pattern = texture_pattern(obj.textures, rest.scale, place);
    fill_warp_directions(cloth.mesh, obj.textures, vector, place);
    cloth.textures = std::move(obj.textures);
    if (!obj.skipped.empty()) cloth.skipped = place_in(at.text(), skipped_sentence(obj.skipped));
    cloth.initial_velocity = read_initial_velocity(reader);
    return cloth;
  });
}

}  // namespace

MeshCloth read_mesh_cloth(const JsonReader& reader, const FileSource& files,
                          const std::optional<Vec3>& usual_warp) {
  return reader.only_one_of({"obj", "positions_m"}) == 0 ? read_obj_mesh(reader, files, usual_warp)
                                                         : read_written_mesh(reader, usual_warp);
}

}  // namespace pleat
