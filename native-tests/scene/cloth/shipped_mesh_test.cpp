#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "core/files/obj_file.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

ObjMesh shipped_mesh(const std::string& name) {
  return read_obj(repository_file("assets/meshes/" + name + ".obj"));
}

int euler_characteristic(const ObjMesh& mesh) {
  return static_cast<int>(mesh.positions.cols()) -
         static_cast<int>(mesh_edges(mesh.triangles).size()) +
         static_cast<int>(mesh.triangles.size());
}

/// The vertices of each border; every vertex of one has one neighbour behind and one ahead.
std::set<std::vector<VertexId>> border_loops(const ObjMesh& mesh) {
  std::map<VertexId, VertexId> next;
  for (const MeshEdge& edge : mesh_edges(mesh.triangles))
    if (edge.is_border()) REQUIRE(next.emplace(edge.a, edge.b).second);
  std::set<std::vector<VertexId>> loops;
  while (!next.empty()) {
    std::vector<VertexId> loop;
    for (auto at = next.begin(); at != next.end(); at = next.find(loop.back())) {
      loop.push_back(at->second);
      next.erase(at);
    }
    std::sort(loop.begin(), loop.end());
    loops.insert(loop);
  }
  return loops;
}

const VertexGroup& group(const ObjMesh& mesh, const std::string& name) {
  const auto found = std::find_if(mesh.groups.begin(), mesh.groups.end(),
                                  [&](const VertexGroup& g) { return g.name == name; });
  REQUIRE(found != mesh.groups.end());
  return *found;
}

Vec3 middle(const ObjMesh& mesh, const std::string& name) {
  Vec3 sum = Vec3::Zero();
  for (const VertexId v : group(mesh, name).vertices) sum += mesh.positions.col(v);
  return sum / static_cast<double>(group(mesh, name).vertices.size());
}

double corner_angle(const ObjMesh& mesh, const Triangle& t, std::size_t k) {
  const Vec3 a = mesh.positions.col(t[(k + 1) % 3]) - mesh.positions.col(t[k]);
  const Vec3 b = mesh.positions.col(t[(k + 2) % 3]) - mesh.positions.col(t[k]);
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double smallest_angle(const ObjMesh& mesh) {
  double smallest = M_PI;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) smallest = std::min(smallest, corner_angle(mesh, t, k));
  return smallest * 180 / M_PI;
}

/// Sides in the pattern over sides in space, the shortest and the longest.
std::pair<double, double> stretch_of_pattern(const ObjMesh& mesh) {
  std::pair<double, double> range{1, 1};
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      const CornerTexture& flat = mesh.textures[f].value();
      const Triangle& t = mesh.triangles[f];
      const double ratio = (mesh.positions.col(t[static_cast<std::size_t>(k)]) -
                            mesh.positions.col(t[static_cast<std::size_t>(next)]))
                               .norm() /
                           (flat.col(k) - flat.col(next)).norm();
      range = {std::min(range.first, ratio), std::max(range.second, ratio)};
    }
  return range;
}

}  // namespace

TEST_CASE("shipped mesh: the T-shirt has 1714 vertices and four openings with names", "[scene]") {
  const ObjMesh shirt = shipped_mesh("t_shirt");
  CHECK(shirt.positions.cols() == 1714);
  CHECK(euler_characteristic(shirt) == 2 - 4);
  std::set<std::vector<VertexId>> named;
  for (const char* name : {"neck", "hem", "left_sleeve", "right_sleeve"})
    named.insert(group(shirt, name).vertices);
  CHECK(shirt.groups.size() == 4);
  CHECK(border_loops(shirt) == named);
  CHECK(smallest_angle(shirt) > 20);
}

TEST_CASE("shipped mesh: the T-shirt is a shirt for a person", "[scene]") {
  const ObjMesh shirt = shipped_mesh("t_shirt");
  CHECK(middle(shirt, "neck").y() - middle(shirt, "hem").y() == Approx(0.65).margin(0.1));
  CHECK(middle(shirt, "left_sleeve").x() == Approx(0.4).margin(0.05));
  CHECK(middle(shirt, "right_sleeve").x() == Approx(-middle(shirt, "left_sleeve").x()));
  for (const char* name : {"neck", "hem"}) CHECK(std::abs(middle(shirt, name).x()) < 1e-3);
  // Front and back are one another's mirror images, apart but where they are sewn.
  std::set<std::array<long, 3>> places;
  const auto key = [](const Vec3& x) {
    return std::array{std::lround(1e6 * x.x()), std::lround(1e6 * x.y()), std::lround(1e6 * x.z())};
  };
  for (const Vec3 x : shirt.positions.colwise()) places.insert(key(x));
  CHECK(places.size() == 1714);
  for (const Vec3 x : shirt.positions.colwise())
    CHECK(places.count(key({x.x(), x.y(), -x.z()})) == 1);
  CHECK(shirt.positions.row(2).maxCoeff() == Approx(0.05));
  // Panels roll up without stretch but at the armpit, whose radius of 50 mm the rounding makes pi/2
  // times as large.
  const auto [shortest, longest] = stretch_of_pattern(shirt);
  CHECK(shortest > 0.97);
  CHECK(longest < 1.001 * M_PI / 2);
  // Normals point out of it.
  double volume = 0;
  for (const Triangle& t : shirt.triangles)
    volume += shirt.positions.col(t[0]).dot(
                  Vec3(shirt.positions.col(t[1])).cross(Vec3(shirt.positions.col(t[2])))) /
              6;
  CHECK(volume > 0);
}

TEST_CASE("shipped mesh: the half skirt is a tube of 1361 vertices with corners of its hem",
          "[scene]") {
  const ObjMesh skirt = shipped_mesh("half_skirt");
  CHECK(skirt.positions.cols() == 1361);
  CHECK(euler_characteristic(skirt) == 0);
  CHECK(border_loops(skirt) ==
        std::set{group(skirt, "waist").vertices, group(skirt, "hem").vertices});
  CHECK(smallest_angle(skirt) > 25);
  const double radius = (0.7 / M_PI + 0.55) / 2;
  const double low = 1 - 0.55 * std::sqrt(0.75);
  for (const auto& [name, corner] : {std::pair("hem_front", Vec3(0, low, radius)),
                                     {"hem_back", Vec3(0, low, -radius)},
                                     {"hem_left", Vec3(radius, low, 0)},
                                     {"hem_right", Vec3(-radius, low, 0)}}) {
    CAPTURE(name);
    CHECK(group(skirt, name).vertices.size() > 3);
    for (const VertexId v : group(skirt, name).vertices)
      CHECK((skirt.positions.col(v) - corner).norm() <= 0.040001);
  }
  const auto [shortest, longest] = stretch_of_pattern(skirt);
  CHECK(shortest > 0.99);
  CHECK(longest < 1.001);
}

TEST_CASE("shipped mesh: the irregular sheet is Delaunay's and has 329 vertices", "[scene]") {
  const ObjMesh sheet = shipped_mesh("delaunay_sheet");
  CHECK(sheet.positions.cols() == 329);
  CHECK(euler_characteristic(sheet) == 1);
  CHECK(smallest_angle(sheet) > 20);
  double area = 0;
  for (const Triangle& t : sheet.triangles) {
    const Vec3 doubled = (sheet.positions.col(t[1]) - sheet.positions.col(t[0]))
                             .cross(Vec3(sheet.positions.col(t[2]) - sheet.positions.col(t[0])));
    CHECK(doubled.y() > 0);
    area += doubled.y() / 2;
  }
  CHECK(area == Approx(0.46 * 0.4).epsilon(1e-5));
  // The angles opposite of an edge sum to at most a half turn.
  for (const MeshEdge& edge : mesh_edges(sheet.triangles)) {
    if (edge.is_border()) continue;
    double opposite = 0;
    for (std::size_t side = 0; side < 2; ++side) {
      const Triangle& t = sheet.triangles[static_cast<std::size_t>(edge.faces[side].value)];
      for (std::size_t k = 0; k < 3; ++k)
        if (t[k] == edge.across[side]) opposite += corner_angle(sheet, t, k);
    }
    CHECK(opposite < M_PI + 1e-4);
  }
  // Irregular: inner vertices of 5, 6 and 7 triangles.
  std::map<VertexId, int> n_triangles;
  for (const Triangle& t : sheet.triangles)
    for (const VertexId v : t) ++n_triangles[v];
  for (const int n : {5, 6, 7})
    CHECK(std::count_if(n_triangles.begin(), n_triangles.end(),
                        [&](const auto& entry) { return entry.second == n; }) > 20);
}

}  // namespace pleat
