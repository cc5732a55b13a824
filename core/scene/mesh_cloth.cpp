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
using Textures = std::vector<std::optional<CornerTexture>>;

enum class RestShape { positions, texture };
constexpr std::array<Word<RestShape>, 2> kRestShapes{
    {{"positions", RestShape::positions}, {"texture", RestShape::texture}}};

/// Height over length; files often carry six digits.
constexpr double kSlimmest = 1e-6;

/// Twice the area of a triangle in the plane, positive when it is wound to the left.
double doubled_area(const CornerTexture& corners) {
  const Eigen::Vector2d a = corners.col(1) - corners.col(0);
  const Eigen::Vector2d b = corners.col(2) - corners.col(0);
  return a.x() * b.y() - a.y() * b.x();
}

bool has_area(const CornerTexture& corners) {
  const double longest = std::max({(corners.col(1) - corners.col(0)).squaredNorm(),
                                   (corners.col(2) - corners.col(1)).squaredNorm(),
                                   (corners.col(0) - corners.col(2)).squaredNorm()});
  return std::abs(doubled_area(corners)) > kSlimmest * longest;
}

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
  if (!has_area(texture)) return Vec3::Zero();
  const double t_of_a = texture(1, 1) - texture(1, 0);
  const double t_of_b = texture(1, 2) - texture(1, 0);
  return in_plane((t_of_b * (x[1] - x[0]) - t_of_a * (x[2] - x[0])) / doubled_area(texture), x);
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
void fill_warp_directions(TriangleMesh& mesh, const Textures& textures,
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

/// Throws InputError{place} for a triangle of the pattern that cloth cannot be cut to.
void check_cut(const CornerTexture& corners, const std::string& place) {
  if (!has_area(corners))
    throw InputError(place,
                     "expected a triangle with an area in the flat pattern, got one without");
  if (doubled_area(corners) < 0)
    throw InputError(place,
                     "expected a triangle wound alike in the mesh and in the flat pattern, got one "
                     "turned over there");
}

/// The flat pattern that a mesh's texture coordinates are.
///
/// scale  [m] per unit of the texture
template <class Place>
std::vector<CornerTexture> texture_pattern(const Textures& textures, double scale, Place&& place) {
  std::vector<CornerTexture> pattern;
  for (std::size_t f = 0; f < textures.size(); ++f) {
    if (!textures[f])
      throw InputError(place(f),
                       "expected texture coordinates, of which \"rest\": \"texture\" makes the "
                       "flat pattern, got none");
    pattern.push_back(scale * *textures[f]);
    check_cut(pattern.back(), place(f));
  }
  return pattern;
}

/// What a mesh says of its rest shape.
struct RestChoice {
  bool is_texture = false;
  double scale = 1;  // [m] per unit of the texture
};

RestChoice read_rest(const JsonReader& reader) {
  RestChoice choice;
  if (const auto at = reader.find("rest"))
    choice.is_texture = at->word(kRestShapes) == RestShape::texture;
  const auto scale = reader.find("texture_scale_m");
  if (scale && !choice.is_texture) scale->fail("no such key without \"rest\": \"texture\"");
  if (scale) choice.scale = scale->number(kPositive);
  if (const auto warp = reader.find("warp_direction"); warp && choice.is_texture)
    warp->fail("no such key with \"rest\": \"texture\", which says how the threads run");
  return choice;
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

Textures corner_textures(const RestCoordinates& coordinates,
                         const std::vector<Triangle>& triangles) {
  Textures textures(triangles.size());
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
  reader.allow_keys(
      {"obj", "rest", "texture_scale_m", "warp_direction", "initial_velocity_m_per_s"});
  const JsonReader at = reader.at("obj");
  at.text();
  if (!files) at.fail("a mesh written out in the scene, as no files can be read here");
  const std::optional<Vec3> vector = read_warp_vector(reader, usual_warp);
  const RestChoice rest = read_rest(reader);
  return read_named_file(at, files, [&](const std::string& text) {
    ObjMesh obj = read_obj(text);
    const auto place = [&](std::size_t f) { return "line " + std::to_string(obj.lines[f]); };
    MeshCloth cloth;
    cloth.texture_coordinates = vertex_textures(obj);
    cloth.mesh.rest_positions = std::move(obj.positions);
    cloth.mesh.triangles = std::move(obj.triangles);
    cloth.groups = std::move(obj.groups);
    if (rest.is_texture) cloth.mesh.pattern = texture_pattern(obj.textures, rest.scale, place);
    fill_warp_directions(cloth.mesh, obj.textures, vector, place);
    cloth.textures = std::move(obj.textures);
    if (!obj.skipped.empty()) cloth.skipped = place_in(at.text(), skipped_sentence(obj.skipped));
    return cloth;
  });
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

MeshCloth read_inline_mesh(const JsonReader& reader, const std::optional<Vec3>& usual_warp) {
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
  Textures threads = cloth.textures;
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
