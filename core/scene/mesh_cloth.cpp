#include "core/scene/mesh_cloth.h"

#include <algorithm>
#include <limits>

#include "core/base/check.h"
#include "core/files/obj_file.h"
#include "core/mesh/mesh_fault.h"
#include "core/mesh/mesh_lines.h"
#include "core/scene/vertex_arrays.h"
#include "core/scene/vertex_place.h"

namespace pleat {
namespace {

using Corners = std::array<Vec3, 3>;

Corners corners_of(const TriangleMesh& mesh, const Triangle& t) {
  const Positions& x = mesh.rest_positions;
  return {x.col(t[0]), x.col(t[1]), x.col(t[2])};
}

/// The direction's part in the plane, of unit length. It is in the plane up to rounding however
/// steep the direction was to it, and zero when that was perpendicular.
Vec3 in_plane(const Vec3& direction, const Corners& x) {
  const Vec3 nearly = direction_in_plane(direction, x[0], x[1], x[2]);
  return direction_in_plane(nearly, x[0], x[1], x[2]);
}

/// The texture is x(s, t) = x0 + s S + t T in the triangle: its sides give S, the direction of s.
/// Zero when the texture has no area.
Vec3 texture_direction(const CornerTexture& texture, const Corners& x) {
  constexpr double kSlimmest = 1e-6;  // height over length; files often carry six digits
  const Eigen::Vector2d a = texture.col(1) - texture.col(0);
  const Eigen::Vector2d b = texture.col(2) - texture.col(0);
  const double doubled_area = a.x() * b.y() - a.y() * b.x();
  if (std::abs(doubled_area) <= kSlimmest * std::max(a.squaredNorm(), b.squaredNorm()))
    return Vec3::Zero();
  return in_plane((b.y() * (x[1] - x[0]) - a.y() * (x[2] - x[0])) / doubled_area, x);
}

/// Zero where neither texture nor vector says it.
Vec3 warp_direction(const std::optional<CornerTexture>& texture, const std::optional<Vec3>& vector,
                    const Corners& x) {
  Vec3 along = texture ? texture_direction(*texture, x) : Vec3(0, 0, 0);
  if (!along.isZero(0) || !vector) return along;
  const Vec3 nearest = in_plane(*vector, x);
  return nearest.isZero(0) ? in_plane(x[1] - x[0], x) : nearest;
}

/// Fills in the warp directions. `place` tells where a triangle stands in the input.
template <class Place>
void fill_warp_directions(TriangleMesh& mesh,
                          const std::vector<std::optional<CornerTexture>>& textures,
                          const std::optional<Vec3>& vector, Place&& place) {
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    mesh.warp_directions.push_back(
        warp_direction(textures[f], vector, corners_of(mesh, mesh.triangles[f])));
    if (mesh.warp_directions.back().isZero(0))
      throw InputError(place(f),
                       "expected texture coordinates with an area, or \"warp_direction\" in the "
                       "scene, to tell how the threads run, got neither");
  }
}

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

std::vector<std::optional<CornerTexture>> corner_textures(const RestCoordinates& coordinates,
                                                          const std::vector<Triangle>& triangles) {
  std::vector<std::optional<CornerTexture>> textures(triangles.size());
  if (coordinates.cols() == 0) return textures;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    textures[f].emplace();
    for (std::size_t k = 0; k < 3; ++k)
      textures[f]->col(static_cast<Eigen::Index>(k)) = coordinates.col(triangles[f][k]);
  }
  return textures;
}

std::optional<Vec3> read_warp_vector(const JsonReader& reader, const std::optional<Vec3>& usual) {
  const auto at = reader.find("warp_direction");
  return at ? at->direction() : usual;
}

MeshCloth read_obj_mesh(const JsonReader& reader, const FileSource& files,
                        const std::optional<Vec3>& usual_warp) {
  reader.allow_keys({"obj", "warp_direction", "initial_velocity_m_per_s"});
  const JsonReader at = reader.at("obj");
  const std::string& name = at.text();
  if (!files) at.fail("a mesh written out in the scene, as no files can be read here");
  const std::optional<Vec3> vector = read_warp_vector(reader, usual_warp);
  const std::string text = files(name);
  try {
    ObjMesh obj = read_obj(text);
    MeshCloth cloth;
    cloth.texture_coordinates = vertex_textures(obj);
    cloth.mesh.rest_positions = std::move(obj.positions);
    cloth.mesh.triangles = std::move(obj.triangles);
    cloth.groups = std::move(obj.groups);
    fill_warp_directions(cloth.mesh, obj.textures, vector,
                         [&](std::size_t f) { return "line " + std::to_string(obj.lines[f]); });
    cloth.textures = std::move(obj.textures);
    return cloth;
  } catch (const InputError& error) {
    throw InputError(place_in(name, error.where()), error.what());
  }
}

RestCoordinates read_texture_coordinates(const JsonReader& reader, std::size_t n_vertices) {
  RestCoordinates coordinates(2, static_cast<Eigen::Index>(n_vertices));
  Eigen::Index column = 0;
  for (const JsonReader& element : reader.elements(n_vertices)) {
    const std::vector<JsonReader> pair = element.elements(2);
    coordinates.col(column++) << pair[0].number(), pair[1].number();
  }
  return coordinates;
}

std::vector<VertexGroup> read_groups(const JsonReader& reader, std::int64_t n_vertices) {
  std::vector<VertexGroup> groups;
  for (const auto& [name, at] : reader.members()) {
    std::vector<VertexId> vertices = read_vertex_list(at, n_vertices);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    groups.push_back({name, std::move(vertices)});
  }
  return groups;
}

/// A direction in its plane within rounding is kept to the bit, so that what was written is read
/// back.
Vec3 read_warp_direction(const JsonReader& reader, const Corners& x) {
  constexpr double kRounding = 1e-14;
  const Vec3 given = reader.direction();
  const Vec3 along = in_plane(given, x);
  if (along.isZero(0)) reader.fail("a direction that is not perpendicular to the triangle");
  return (along - given).norm() < kRounding ? given : along;
}

void read_warp_directions(const JsonReader& reader, TriangleMesh& mesh) {
  std::size_t f = 0;
  for (const JsonReader& element : reader.elements(mesh.triangles.size()))
    mesh.warp_directions.push_back(
        read_warp_direction(element, corners_of(mesh, mesh.triangles[f++])));
}

MeshCloth read_inline_mesh(const JsonReader& reader, const std::optional<Vec3>& usual_warp) {
  reader.allow_keys({"positions_m", "triangles", "warp_direction", "warp_directions",
                     "texture_coordinates", "groups", "initial_velocity_m_per_s"});
  MeshCloth cloth;
  TriangleMesh& mesh = cloth.mesh;
  mesh.rest_positions = read_positions(reader.at("positions_m"));
  const int n = mesh.n_vertices();
  const JsonReader triangles = reader.at("triangles");
  for (const JsonReader& triangle : triangles.elements())
    mesh.triangles.push_back(read_vertices<3>(triangle, n));
  const auto place = [&](std::size_t f) { return triangles.pointer() + "/" + std::to_string(f); };
  if (const auto fault = mesh_fault(mesh.rest_positions, mesh.triangles, 0))
    throw InputError(fault->vertex.valid()
                         ? reader.at("positions_m").pointer() + "/" + std::to_string(fault->vertex)
                         : place(static_cast<std::size_t>(fault->triangle)),
                     fault->sentence);
  if (const auto at = reader.find("texture_coordinates"))
    cloth.texture_coordinates = read_texture_coordinates(*at, static_cast<std::size_t>(n));
  if (const auto at = reader.find("groups")) cloth.groups = read_groups(*at, n);
  cloth.textures = corner_textures(cloth.texture_coordinates, mesh.triangles);
  if (const auto at = reader.find("warp_directions")) {
    if (reader.find("warp_direction")) at->fail("either this or warp_direction");
    read_warp_directions(*at, mesh);
  } else {
    fill_warp_directions(mesh, cloth.textures, read_warp_vector(reader, usual_warp), place);
  }
  return cloth;
}

}  // namespace

const char* MeshCloth::key() const { return "mesh"; }

Json MeshCloth::json() const {
  Json json;
  json["positions_m"] = json_columns(mesh.rest_positions);
  json["triangles"] = Json::array();
  for (const Triangle& triangle : mesh.triangles)
    json["triangles"].push_back(json_vertices(triangle));
  json["warp_directions"] = Json::array();
  for (const Vec3& direction : mesh.warp_directions)
    json["warp_directions"].push_back(json_vec3(direction));
  json["groups"] = Json::object();
  for (const VertexGroup& group : groups)
    json["groups"][group.name] = json_vertices(group.vertices);
  json["initial_velocity_m_per_s"] = json_vec3(initial_velocity);
  if (texture_coordinates.cols() == 0) return json;
  json["texture_coordinates"] = Json::array();
  for (const auto& pair : texture_coordinates.colwise())
    json["texture_coordinates"].push_back({pair.x(), pair.y()});
  return json;
}

/// Each level puts a vertex on every edge, halves the edge and joins the three of each triangle.
std::int64_t MeshCloth::n_vertices(int level) const {
  std::int64_t n = mesh.n_vertices();
  auto n_triangles = static_cast<std::int64_t>(mesh.triangles.size());
  auto n_edges = static_cast<std::int64_t>(level > 0 ? mesh_edges(mesh.triangles).size() : 0);
  for (; level > 0; --level) {
    n += n_edges;
    n_edges = 2 * n_edges + 3 * n_triangles;
    n_triangles *= 4;
  }
  return n;
}

RestCloth MeshCloth::at_rest(int level) const {
  RestCloth cloth;
  std::vector<std::array<VertexId, 2>> middles;
  cloth.mesh = subdivided(mesh, level, &middles);
  cloth.start = cloth.mesh.rest_positions;
  cloth.start_velocities = initial_velocity.replicate(1, cloth.start.cols());
  const int n = mesh.n_vertices();
  for (const VertexGroup& group : groups) cloth.groups.push_back(refined(group, n, middles));
  if (texture_coordinates.cols() == 0) return cloth;
  cloth.rest_coordinates.resize(2, cloth.mesh.n_vertices());
  cloth.rest_coordinates.leftCols(n) = texture_coordinates;
  Eigen::Index column = n;
  for (const auto& [a, b] : middles)
    cloth.rest_coordinates.col(column++) =
        (cloth.rest_coordinates.col(a) + cloth.rest_coordinates.col(b)) / 2;
  return cloth;
}

double MeshCloth::rest_diagonal() const {
  return mesh.rest_positions.cols() == 0 ? 0 : box_diagonal(mesh.rest_positions);
}

std::string MeshCloth::read_part(const JsonReader& reader) const {
  return read_group(reader, groups).name;
}

std::vector<VertexId> MeshCloth::base_part(const std::string& name) const {
  return vertices_of(groups, name);
}

MeshCloth read_mesh_cloth(const JsonReader& reader, const FileSource& files,
                          const std::optional<Vec3>& usual_warp) {
  const bool is_file = reader.only_one_of({"obj", "positions_m"}) == 0;
  MeshCloth cloth =
      is_file ? read_obj_mesh(reader, files, usual_warp) : read_inline_mesh(reader, usual_warp);
  if (const auto at = reader.find("initial_velocity_m_per_s")) cloth.initial_velocity = at->vec3();
  return cloth;
}

}  // namespace pleat
