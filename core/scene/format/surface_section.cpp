#include "core/scene/format/surface_section.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "core/base/check.h"
#include "core/base/formatted.h"
#include "core/contact/surface_crossings.h"
#include "core/files/obj_file.h"
#include "core/mesh/edge_key.h"
#include "core/mesh/mesh_fault.h"
#include "core/scene/vertex_arrays.h"

namespace pleat {
namespace {

constexpr const char* kBox = "box";
constexpr const char* kMesh = "mesh";

std::string place_of(const Vec3& x) { return formatted("(%.4g, %.4g, %.4g)", x[0], x[1], x[2]); }

BoxSolid read_box_solid(const JsonReader& reader) {
  reader.allow_keys({"centre_m", "size_m", "x_direction", "y_direction"});
  BoxSolid box;
  if (const auto at = reader.find("centre_m")) box.centre = at->vec3();
  Eigen::Index axis = 0;
  for (const JsonReader& size : reader.at("size_m").elements(3))
    box.size[axis++] = size.number(kPositive);
  read_perpendicular(reader, {"x_direction", "y_direction"}, box.x_direction, box.y_direction);
  return box;
}

/// The first border of a surface whose edges have two triangles at most, wound alike.
void expect_closed(const MeshSolid& mesh, int first_vertex) {
  std::map<std::uint64_t, int> sides;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++sides[edge_key(t[k], t[(k + 1) % 3])];
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = t[k];
      const VertexId b = t[(k + 1) % 3];
      if (sides[edge_key(a, b)] == 2) continue;
      const Vec3 middle = (mesh.places.col(a) + mesh.places.col(b)) / 2;
      throw InputError(
          "", formatted("expected a closed surface, got one triangle alone at the "
                        "edge from vertex %d to %d, at %s m",
                        a.value + first_vertex, b.value + first_vertex, place_of(middle).c_str()));
    }
}

void expect_simple(const MeshSolid& mesh, int first_vertex) {
  const std::vector<SurfaceCrossing> found = own_crossings(mesh.places, mesh.triangles);
  if (found.empty()) return;
  const auto& [edge, face, place] = found.front();
  throw InputError(
      "", formatted("expected a surface that does not pass through itself, got %d crossings, the "
                    "first of the edge from vertex %d to %d at %s m",
                    static_cast<int>(found.size()), edge[0].value + first_vertex,
                    edge[1].value + first_vertex, place_of(place).c_str()));
}

/// Files wind their surfaces either way: it is turned so that normals lead out.
void check_body(MeshSolid& mesh, int first_vertex) {
  expect_closed(mesh, first_vertex);
  expect_simple(mesh, first_vertex);
  if (enclosed_volume(mesh.places, mesh.triangles) < 0)
    for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

MeshSolid read_obj_solid(const JsonReader& reader, const FileSource& files) {
  reader.allow_keys({"obj"});
  const JsonReader at = reader.at("obj");
  at.text();
  if (!files) at.fail("a mesh written out in the scene, as no files can be read here");
  return read_named_file(at, files, [&](const std::string& text) {
    ObjMesh obj = read_obj(text);
    MeshSolid mesh{std::move(obj.positions), std::move(obj.triangles), {}};
    check_body(mesh, 1);
    if (!obj.skipped.empty()) mesh.skipped = place_in(at.text(), skipped_sentence(obj.skipped));
    return mesh;
  });
}

MeshSolid read_written_solid(const JsonReader& reader) {
  reader.allow_keys({"positions_m", "triangles"});
  MeshSolid mesh;
  mesh.places = read_positions(reader.at("positions_m"));
  const JsonReader triangles = reader.at("triangles");
  for (const JsonReader& triangle : triangles.elements())
    mesh.triangles.push_back(read_vertices<3>(triangle, mesh.places.cols()));
  if (mesh.triangles.empty()) triangles.fail("at least one triangle");
  try {
    if (const auto fault = mesh_fault(mesh.places, mesh.triangles, 0))
      throw InputError("", fault->sentence);
    check_body(mesh, 0);
  } catch (const InputError& error) {
    throw InputError(reader.pointer(), error.sentence());
  }
  return mesh;
}

Json json_of(const BoxSolid& box) {
  return {{"centre_m", json_vec3(box.centre)},
          {"size_m", json_vec3(box.size)},
          {"x_direction", json_vec3(box.x_direction)},
          {"y_direction", json_vec3(box.y_direction)}};
}

Json json_of(const MeshSolid& mesh) {
  Json triangles = Json::array();
  for (const Triangle& triangle : mesh.triangles) triangles.push_back(json_vertices(triangle));
  return {{"positions_m", json_columns(mesh.places)}, {"triangles", std::move(triangles)}};
}

}  // namespace

std::vector<const char*> surface_words() { return {kBox, kMesh}; }

SurfaceSolid read_surface(const JsonReader& collider, const char* word, const FileSource& files) {
  const JsonReader reader = collider.at(word);
  SurfaceSolid solid;
  if (std::string_view(word) == kBox)
    solid.shape = read_box_solid(reader);
  else if (reader.only_one_of({"obj", "positions_m"}) == 0)
    solid.shape = read_obj_solid(reader, files);
  else
    solid.shape = read_written_solid(reader);
  return solid;
}

const char* word_for(const SurfaceSolid& solid) {
  return std::holds_alternative<BoxSolid>(solid.shape) ? kBox : kMesh;
}

Json json_shape(const SurfaceSolid& solid) {
  return std::visit([](const auto& shape) { return json_of(shape); }, solid.shape);
}

}  // namespace pleat
