#include "core/scene/cloth/mesh_cloth.h"

#include <algorithm>

#include "core/mesh/mesh_fault.h"
#include "core/scene/cloth/mesh_threads.h"
#include "core/scene/vertex_arrays.h"

namespace pleat {
namespace {

CornerTextures corner_textures(const RestCoordinates& coordinates,
                               const std::vector<Triangle>& triangles) {
  CornerTextures textures(triangles.size());
  if (coordinates.cols() == 0) return textures;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    textures[f].emplace();
    for (std::size_t k = 0; k < 3; ++k)
      textures[f]->col(static_cast<Eigen::Index>(k)) = coordinates.col(triangles[f][k]);
  }
  return textures;
}

std::vector<CornerTexture> read_pattern(const JsonReader& reader, std::size_t n_triangles) {
  std::vector<CornerTexture> pattern;
  for (const JsonReader& triangle : reader.elements(n_triangles)) {
    CornerTexture& corners = pattern.emplace_back();
    Eigen::Index column = 0;
    for (const JsonReader& corner : triangle.elements(3)) {
      const std::vector<JsonReader> pair = corner.elements(2);
      corners.col(column++) << pair[0].number(), pair[1].number();
    }
    check_cut(corners, triangle.pointer());
  }
  return pattern;
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

}  // namespace

Json MeshCloth::json() const {
  Json json;
  json["positions_m"] = json_columns(mesh.rest_positions);
  json["triangles"] = Json::array();
  for (const Triangle& triangle : mesh.triangles)
    json["triangles"].push_back(json_vertices(triangle));
  json["warp_directions"] = Json::array();
  for (const Vec3& direction : mesh.warp_directions)
    json["warp_directions"].push_back(json_vec3(direction));
  for (const CornerTexture& corners : mesh.pattern) {
    Json triangle = Json::array();
    for (const auto& corner : corners.colwise()) triangle.push_back({corner.x(), corner.y()});
    json["pattern_m"].push_back(std::move(triangle));
  }
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

Vec3 read_initial_velocity(const JsonReader& reader) {
  const auto at = reader.find("initial_velocity_m_per_s");
  return at ? at->vec3() : Vec3(0, 0, 0);
}

MeshCloth read_written_mesh(const JsonReader& reader, const std::optional<Vec3>& usual_warp) {
  reader.allow_keys({"positions_m", "triangles", "rest", "texture_scale_m", "pattern_m",
                     "warp_direction", "warp_directions", "texture_coordinates", "groups",
                     "initial_velocity_m_per_s"});
  const RestChoice rest = read_rest(reader);
  MeshCloth cloth;
  TriangleMesh& mesh = cloth.mesh;
  mesh.rest_positions = read_positions(reader.at("positions_m"));
  const int n = mesh.n_vertices();
  const JsonReader triangles = reader.at("triangles");
  for (const JsonReader& triangle : triangles.elements())
    mesh.triangles.push_back(read_vertices<3>(triangle, n));
  const TrianglePlace place = [&](std::size_t f) {
    return triangles.pointer() + "/" + std::to_string(f);
  };
  if (const auto fault = mesh_fault(mesh.rest_positions, mesh.triangles, 0))
    throw InputError(fault->vertex.valid()
                         ? reader.at("positions_m").pointer() + "/" + std::to_string(fault->vertex)
                         : place(static_cast<std::size_t>(fault->triangle)),
                     fault->sentence);
  if (const auto at = reader.find("texture_coordinates"))
    cloth.texture_coordinates = read_texture_coordinates(*at, static_cast<std::size_t>(n));
  if (const auto at = reader.find("groups")) cloth.groups = read_groups(*at, n);
  cloth.textures = corner_textures(cloth.texture_coordinates, mesh.triangles);
  CornerTextures threads = cloth.textures;
  if (rest.is_texture) mesh.pattern = texture_pattern(cloth.textures, rest.scale, place);
  if (const auto at = reader.find("pattern_m")) {
    if (rest.is_texture) at->fail("either this or \"rest\": \"texture\"");
    mesh.pattern = read_pattern(*at, mesh.triangles.size());
    threads.assign(mesh.pattern.begin(), mesh.pattern.end());
  }
  if (const auto at = reader.find("warp_directions")) {
    if (reader.find("warp_direction")) at->fail("either this or warp_direction");
    read_warp_directions(*at, mesh);
  } else {
    fill_warp_directions(mesh, threads, read_warp_vector(reader, usual_warp), place);
  }
  cloth.initial_velocity = read_initial_velocity(reader);
  return cloth;
}

}  // namespace pleat
