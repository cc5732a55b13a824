#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/files/frame_file.h"
#include "core/files/obj_file.h"
#include "core/model/elasticity.h"
#include "core/run/simulation.h"
#include "core/scene/cloth/mesh_cloth.h"
#include "core/scene/format/cloth_section.h"
#include "core/scene/format/scene_file.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/cloth.h"

namespace pleat {
namespace {

// Two triangles, folded upright along their common side, with the second texture coordinate
// doubled; warp runs along x.
constexpr const char* kFolded = R"(
v 0 0 0
v 1 0 0
v 0 1 0
v 1 0 2
vt 0 0
vt 1 0
vt 0 2
vt 1 4
g low
f 1/1 2/2 3/3
g high
f 3/3 2/2 4/4
g fold
l 2 3
)";

FileSource source_of(std::string text) {
  return [text = std::move(text)](const std::string&) { return text; };
}

Scene read(const std::string& text, const FileSource& files = source_of(kFolded)) {
  return read_scene(text, fabric_library(), files);
}

Scene obj_scene(const std::string& obj, const std::string& rest = "") {
  return read(R"({"cloth": {"mesh": {"obj": "any.obj")" + rest + "}}}", source_of(obj));
}

const MeshCloth& cloth_of(const Scene& scene) { return *scene.cloth.as<MeshCloth>(); }

std::string without_texture() {
  std::string text = kFolded;
  for (const char* part : {"/1", "/2", "/3", "/4"})
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part))
      text.erase(at, 2);
  return text;
}

Scene skirt() {
  return read(scene_text("skirt"),
              [](const std::string& name) { return repository_file("assets/scenes/" + name); });
}

constexpr int kTubeSides = 12;
constexpr int kTubeRings = 4;
constexpr double kTubeRadius = 0.2;  // [m], of the corners
constexpr double kTubeHeight = 0.5;  // [m]
/// A side of the tube [m].
const double kTubeSide = 2 * kTubeRadius * std::sin(M_PI / kTubeSides);
const double kTubeArea = kTubeSides * kTubeSide * kTubeHeight;  // [m^2]

/// A tube of flat sides whose texture is the rectangle that it is rolled of, in metres: first
/// around, then up. At its seam a vertex has two places in the rectangle.
std::string tube_obj() {
  std::string text;
  for (int ring = 0; ring < kTubeRings; ++ring)
    for (int side = 0; side < kTubeSides; ++side) {
      const double angle = -2 * M_PI * side / kTubeSides;
      const double place[] = {kTubeRadius * std::cos(angle), kTubeHeight * ring / (kTubeRings - 1),
                              kTubeRadius * std::sin(angle)};
      text += obj_line("v", place);
    }
  for (int ring = 0; ring < kTubeRings; ++ring)
    for (int side = 0; side <= kTubeSides; ++side) {
      const double place[] = {kTubeSide * side, kTubeHeight * ring / (kTubeRings - 1)};
      text += obj_line("vt", place);
    }
  const auto corner = [](int ring, int side) {
    return std::to_string(ring * kTubeSides + side % kTubeSides + 1) + "/" +
           std::to_string(ring * (kTubeSides + 1) + side + 1) + " ";
  };
  for (int ring = 0; ring + 1 < kTubeRings; ++ring)
    for (int side = 0; side < kTubeSides; ++side)
      text += "f " + corner(ring, side) + corner(ring, side + 1) + corner(ring + 1, side + 1) +
              corner(ring + 1, side) + "\n";
  return text;
}

Scene tube_scene(const std::string& rest) {
  return obj_scene(tube_obj(), R"(, "rest": "texture")" + rest);
}

double angle_at(const Vec3& corner, const Vec3& b, const Vec3& c) {
  return std::atan2((b - corner).cross(c - corner).norm(), (b - corner).dot(c - corner));
}

std::vector<int> pinned(const Scene& scene) {
  std::vector<int> vertices;
  const Simulation simulation(scene);
  for (const Pin& pin : simulation.model().pins) vertices.push_back(pin.vertex);
  return vertices;
}

}  // namespace

TEST_CASE("mesh scene: warp runs as the first texture coordinate grows and the second stays",
          "[scene]") {
  const Scene scene = obj_scene(kFolded);
  const std::vector<Vec3>& warp = cloth_of(scene).mesh.warp_directions;
  REQUIRE(warp.size() == 2);
  CHECK((warp[0] - Vec3(1, 0, 0)).norm() < 1e-15);
  // x(s, t) of the second: x = s, from (0, 1, 0) at (0, 2), (1, 0, 0) at (1, 0), (1, 0, 2) at (1,
  // 4). With t staying at 2, s grows from the first corner to the middle of the other two: (1, 0,
  // 1).
  CHECK((warp[1] - Vec3(1, -1, 1).normalized()).norm() < 1e-15);
}

TEST_CASE("mesh scene: a sheet's frame is read back with the sheet's own threads", "[scene]") {
  Scene scene;
  scene.level = 2;
  const Simulation sheet(scene);
  const Scene again = obj_scene(
      obj_text({sheet.model().rest_coordinates, sheet.triangles()}, sheet.rest_positions()));
  const MeshCloth& cloth = cloth_of(again);
  CHECK(cloth.texture_coordinates == sheet.model().rest_coordinates);
  for (const Vec3& warp : cloth.mesh.warp_directions)
    CHECK((warp - scene.cloth.as<SheetCloth>()->shape.warp_direction).norm() < 1e-14);
}

TEST_CASE("mesh scene: without texture the vector's projection serves, or the first side",
          "[scene]") {
  const Scene scene = obj_scene(without_texture(), R"(, "warp_direction": [0, 0, -3])");
  const std::vector<Vec3>& warp = cloth_of(scene).mesh.warp_directions;
  CHECK(warp[0] == Vec3(1, 0, 0));  // perpendicular: the first side
  CHECK((warp[1] - Vec3(0, 0, -1)).norm() < 1e-15);
  CHECK(cloth_of(scene).texture_coordinates.cols() == 0);
  // Texture coordinates come first.
  const Scene both = obj_scene(kFolded, R"(, "warp_direction": [0, 1, 0])");
  CHECK((cloth_of(both).mesh.warp_directions[0] - Vec3(1, 0, 0)).norm() < 1e-15);
}

TEST_CASE("mesh scene: a vertex on a seam has no one pair of texture coordinates", "[scene]") {
  std::string text = kFolded;
  CHECK(cloth_of(obj_scene(text)).texture_coordinates.col(3) == Eigen::Vector2d(1, 4));
  text.replace(text.find("f 3/3"), 5, "f 3/1");
  CHECK(cloth_of(obj_scene(text)).texture_coordinates.cols() == 0);
}

TEST_CASE("mesh scene: a tube cut to a flat rectangle is free of strain, however it is sewn",
          "[scene]") {
  const Simulation tube(tube_scene(""));
  const ClothModel& model = tube.model();
  const Positions& x = tube.state().positions;
  CHECK(membrane_energy(model.membrane, x) < 1e-20);
  CHECK(stretch(tube.gauge(), x).largest < 1e-12);
  CHECK(model.masses.sum() == Approx(kTubeArea * tube.scene().fabric.areal_density));
  // Cut in another place of the pattern, the threads still run around it.
  for (const MembraneElement& element : model.membrane.elements) {
    const Vec3 around = x.col(element.vertices[0]) * element.gradients(0, 0) +
                        x.col(element.vertices[1]) * element.gradients(1, 0) +
                        x.col(element.vertices[2]) * element.gradients(2, 0);
    CHECK(std::abs(around.y()) < 1e-12);
    CHECK(around.norm() == Approx(1));
  }
}

TEST_CASE("mesh scene: a tube cut 2 % too small is stretched by 2 % all over", "[scene]") {
  constexpr double kScale = 0.98;
  const Scene scene = tube_scene(R"(, "texture_scale_m": 0.98)");
  const int level = GENERATE(0, 1);
  Scene refined = scene;
  refined.level = level;
  const Simulation tube(refined);
  const ClothModel& model = tube.model();
  const Positions& x = tube.state().positions;
  const double area = kScale * kScale * kTubeArea;
  CHECK(stretch(tube.gauge(), x).rms == Approx(1 / kScale - 1));
  CHECK(stretch(tube.gauge(), x).largest == Approx(1 / kScale - 1));
  CHECK(model.masses.sum() == Approx(area * scene.fabric.areal_density));
  // Green strain E along both threads and none across: W = (K_u + K_v + 2 G) E^2/2.
  const double green = (1 / (kScale * kScale) - 1) / 2;
  const MembraneLaw& law = model.membrane.law;
  CHECK(membrane_energy(model.membrane, x) ==
        Approx(area * (law.stretch_warp + law.stretch_weft + 2 * law.shear) * green * green / 2));
}

TEST_CASE("mesh scene: bending of a tube is that of its flat pattern", "[scene]") {
  const auto tube = [](const std::string& rest) {
    return Simulation(read(
        R"({"cloth": {"mesh": {"obj": "any.obj")" + rest + R"(}}, "fabric": {"name": "wool"}})",
        source_of(tube_obj())));
  };
  // The tube without a pattern has the same lengths.
  const Simulation cut = tube(R"(, "rest": "texture")");
  const Simulation standing = tube("");
  CHECK(cut.model().masses.isApprox(standing.model().masses, 1e-12));
  CHECK(cut.model().fitted_bending.isApprox(standing.model().fitted_bending, 1e-9));
  const double of_cylinder =
      cut.scene().fabric.bend_warp * kTubeArea / (2 * kTubeRadius * kTubeRadius);
  CHECK(elastic_energy(cut.model(), cut.state().positions) == Approx(of_cylinder).epsilon(0.1));
}

TEST_CASE("mesh scene: an edge between two lengths of pattern is as long as their mean",
          "[scene]") {
  const Scene scene = read(R"({"cloth": {"mesh": {"obj": "any.obj", "rest": "texture"}}})",
                           source_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
                                     "vt 0 0\nvt 1 0\nvt 0 1\nvt 0 0\nvt 2 2\nvt -3 3\n"
                                     "f 1/1 2/2 3/3\nf 3/6 2/4 4/5\n"));
  const TriangleMesh& mesh = cloth_of(scene).mesh;
  for (const MeshEdge& edge : mesh_edges(mesh.triangles))
    if (!edge.is_border()) CHECK(rest_length(mesh, edge) == Approx(2 * std::sqrt(2.0)));
  CHECK(rest_area(mesh, FaceId(0)) == Approx(0.5));
  CHECK(rest_area(mesh, FaceId(1)) == Approx(6));
}

TEST_CASE("mesh scene: a flat pattern is written out and read back to the bit", "[scene]") {
  const Scene scene = tube_scene(R"(, "texture_scale_m": 0.3)");
  const Scene again = read(write_scene(scene));
  const auto& pattern = cloth_of(scene).mesh.pattern;
  REQUIRE(cloth_of(again).mesh.pattern.size() == pattern.size());
  for (std::size_t f = 0; f < pattern.size(); ++f)
    CHECK(cloth_of(again).mesh.pattern[f] == pattern[f]);
  CHECK(write_scene(again) == write_scene(scene));
}

TEST_CASE("mesh scene: faults of the file are told with its name and line", "[scene]") {
  const auto fault = [](const std::string& obj) {
    try {
      obj_scene(obj);
    } catch (const InputError& error) {
      return error.where() + ": " + error.sentence();
    }
    return std::string("was accepted");
  };
  CHECK(fault("v 0 0 x\n") == "any.obj: line 1: expected a number, got \"x\"");
  CHECK(fault("") == "any.obj: expected vertices (v), got none");
  const std::string untold =
      "expected texture coordinates with an area, or \"warp_direction\" in the scene, to tell how "
      "the threads run, got neither";
  CHECK(fault(without_texture()) == "any.obj: line 11: " + untold);
  std::string flat = kFolded;
  flat.replace(flat.find("vt 1 4"), 6, "vt 2 -2");
  CHECK(fault(flat) == "any.obj: line 13: " + untold);
}

TEST_CASE("mesh scene: what is written is the whole mesh and reads back to the bit", "[scene]") {
  for (std::string obj : {std::string(kFolded), without_texture()}) {
    // The first triangle is slim and nearly perpendicular to the vector: projections lose digits.
    obj.replace(obj.find("v 0 1 0"), 7, "v 0.5 0.00003 0.00001");
    const Scene scene = read(R"({"cloth": {"mesh": {"obj": "a.obj", "warp_direction": [1e-4, -1, 3],
        "initial_velocity_m_per_s": [0.1, 0.2, 0.3]}},
        "pins": [{"part": "fold"}, {"box": {"low_m": [0.3, -1, 1], "high_m": [1, 1, 2.1]},
                  "motion": {"kind": "ease", "offset_m": [0.1, 0, 0], "end_s": 0.3}}]})",
                             source_of(obj));
    const std::string written = write_scene(scene);
    const Scene again = read_scene(written, fabric_library());
    CHECK(write_scene(again) == written);
    const MeshCloth& a = cloth_of(scene);
    const MeshCloth& b = cloth_of(again);
    CHECK(a.mesh.rest_positions == b.mesh.rest_positions);
    CHECK(a.mesh.triangles == b.mesh.triangles);
    CHECK(a.mesh.warp_directions == b.mesh.warp_directions);
    CHECK(a.texture_coordinates == b.texture_coordinates);
    REQUIRE(a.groups.size() == b.groups.size());
    for (std::size_t g = 0; g < a.groups.size(); ++g) {
      CHECK(a.groups[g].name == b.groups[g].name);
      CHECK(a.groups[g].vertices == b.groups[g].vertices);
    }
    CHECK(b.initial_velocity == a.initial_velocity);
  }
}

TEST_CASE("mesh scene: pins by number, box and name hold what they say", "[scene]") {
  const auto held = [](const std::string& pins, int level) {
    return pinned(read(R"({"cloth": {"mesh": {"obj": "a.obj"}}, "refinement": {"level": )" +
                       std::to_string(level) + R"(}, "pins": [)" + pins + "]}"));
  };
  CHECK(held(R"({"vertices": [3, 1]})", 1) == std::vector<int>{3, 1});
  CHECK(held(R"({"part": "fold"})", 0) == std::vector<int>{1, 2});
  CHECK(held(R"({"part": "fold"})", 2).size() == 5);
  CHECK(held(R"({"part": "high"})", 0) == std::vector<int>{1, 2, 3});
  CHECK(held(R"({"part": "high"})", 1).size() == 6);
  const std::string box = R"({"box": {"low_m": [0, 0, 0], "high_m": [1, 0, 1]}})";
  CHECK(held(box, 0) == std::vector<int>{0, 1});
  CHECK(held(box, 1).size() == 4);  // and the middles of 0-1 and 1-3
}

TEST_CASE("mesh scene: a box pins a sheet and particles too", "[scene]") {
  Scene sheet;
  sheet.level = 1;
  sheet.pins = {{PinBox{{-1, -0.5, 0}, {2, 0, 0}}, {}}};
  CHECK(pinned(sheet).size() == 6);  // two rows of three
  const Scene chain =
      read(R"({"cloth": {"particles": {"positions_m": [[0, 0, 0], [0, 1, 0], [0, 2, 0]],
      "masses_kg": [1, 1, 1]}}, "pins": [{"box": {"low_m": [0, 1, 0], "high_m": [0, 2, 0]}}]})");
  CHECK(pinned(chain) == std::vector<int>{1, 2});
}

TEST_CASE("mesh scene: each vertex weighs a third of the cloth around it", "[scene]") {
  const int level = GENERATE(0, 3);
  Scene scene = obj_scene(kFolded);
  scene.level = level;
  scene.air.emplace();
  change_cloth<MeshCloth>(scene, [](MeshCloth& mesh) { mesh.initial_velocity = {1, 2, 3}; });
  scene.fabric.areal_density = 0.3;
  const Simulation simulation(scene);
  const double low = 0.5;
  const double high = std::sqrt(2.0);  // half of |(1, -1, 0) x (1, -1, 2)|
  CHECK(simulation.rest_areas().sum() == Approx(low + high).epsilon(1e-14));
  if (level == 0) CHECK(simulation.rest_areas()[3] == Approx(high / 3).epsilon(1e-14));
  CHECK((simulation.model().masses - 0.3 * simulation.rest_areas()).norm() < 1e-15);
  REQUIRE(simulation.model().air);
  CHECK(simulation.model().air->triangles() == simulation.triangles());
  CHECK(simulation.triangles().size() == std::size_t{2} << (2 * level));
  CHECK(simulation.state().velocities.col(0) == Vec3(1, 2, 3));
  CHECK(simulation.model().rest_coordinates.cols() == simulation.model().n_vertices());
  CHECK(scene.cloth->rest_diagonal() == Approx(std::sqrt(6.0)).epsilon(1e-15));
}

TEST_CASE("mesh scene: a level's vertices are counted before they are made", "[scene]") {
  Scene scene = obj_scene(kFolded);
  for (int level = 0; level <= 4; ++level)
    CHECK(rest_cloth(scene, level).mesh.n_vertices() == scene.cloth->n_vertices(level));
  Scene large = skirt();
  CHECK_NOTHROW(check_level(large, 4, "/refinement/level"));
  CHECK_THROWS_AS(check_level(large, 5, "/refinement/level"), InputError);
}

TEST_CASE("mesh scene: texture coordinates and drawn triangles follow the refinement", "[scene]") {
  const Scene scene = obj_scene(kFolded);
  const RestCloth fine = rest_cloth(scene, 2);
  // Texture coordinates are affine in each triangle, and so are their middles.
  const MeshCloth& base = cloth_of(scene);
  for (int i = 0; i < fine.mesh.n_vertices(); ++i) {
    const Vec3 x = fine.mesh.rest_positions.col(i);
    const Eigen::Vector2d st = fine.rest_coordinates.col(i);
    CHECK(st.x() == Approx(x.x()).margin(1e-15));
    CHECK(st.y() == Approx(2 * x.y() + 2 * x.z()).margin(1e-15));
  }
  CHECK(fine.rest_coordinates.leftCols(4) == base.texture_coordinates);
}

TEST_CASE("mesh scene: a hand takes the vertices around the one it grabs", "[scene]") {
  Scene scene = skirt();
  scene.pins.clear();
  Simulation simulation(scene);
  simulation.grab(VertexId(40));
  const double radius = kHandRadius * scene.cloth->rest_diagonal();
  const auto n_held = simulation.model().pins.size();
  const Positions& x = simulation.rest_positions();
  CHECK(static_cast<std::ptrdiff_t>(n_held) ==
        ((x.colwise() - x.col(40)).colwise().norm().array() <= radius).count());
  CHECK(n_held > 3);
  simulation.release_grab();
  CHECK(simulation.model().pins.empty());
}

TEST_CASE("mesh scene: the skirt is a tube of well-shaped triangles", "[scene]") {
  const Scene scene = skirt();
  const TriangleMesh& mesh = cloth_of(scene).mesh;
  const std::vector<MeshEdge> edges = mesh_edges(mesh.triangles);
  CHECK(mesh.n_vertices() > 2000);
  CHECK(mesh.n_vertices() < 3000);
  CHECK(mesh.n_vertices() + mesh.triangles.size() == edges.size());
  double smallest = M_PI;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      smallest = std::min(
          smallest, angle_at(mesh.rest_positions.col(t[k]), mesh.rest_positions.col(t[(k + 1) % 3]),
                             mesh.rest_positions.col(t[(k + 2) % 3])));
  CHECK(smallest > 20 * M_PI / 180);
  // The two borders are the two groups.
  const std::vector<VertexGroup>& groups = cloth_of(scene).groups;
  REQUIRE(groups.size() == 2);
  std::vector<bool> is_named(static_cast<std::size_t>(mesh.n_vertices()), false);
  for (const VertexGroup& group : groups)
    for (const VertexId v : group.vertices) is_named[v] = true;
  std::size_t n_borders = 0;
  for (const MeshEdge& edge : edges) {
    if (!edge.is_border()) continue;
    ++n_borders;
    CHECK((is_named[edge.a] && is_named[edge.b]));
  }
  CHECK(n_borders == groups[0].vertices.size() + groups[1].vertices.size());
  CHECK(groups[0].name == "waist");
  for (const VertexId v : groups[0].vertices) {
    const Vec3 x = mesh.rest_positions.col(v);
    CHECK(x.y() == Approx(1));
    CHECK(std::hypot(x.x(), x.z()) == Approx(0.7 / (2 * M_PI)).epsilon(1e-5));
  }
}

TEST_CASE("mesh scene: the skirt's pattern was rolled up without stretch", "[scene]") {
  const ObjMesh skirt = read_obj(repository_file("assets/meshes/skirt.obj"));
  double area = 0;
  for (std::size_t f = 0; f < skirt.triangles.size(); ++f) {
    REQUIRE(skirt.textures[f]);
    const CornerTexture& flat = *skirt.textures[f];
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      const double length =
          (skirt.positions.col(skirt.triangles[f][static_cast<std::size_t>(k)]) -
           skirt.positions.col(skirt.triangles[f][static_cast<std::size_t>(next)]))
              .norm();
      CHECK(length == Approx((flat.col(k) - flat.col(next)).norm()).epsilon(0.01));
    }
    area += Eigen::Matrix2d(flat.rightCols<2>().colwise() - flat.col(0)).determinant() / 2;
  }
  const double r0 = 0.7 / M_PI, r1 = r0 + 0.55;
  CHECK(area == Approx(M_PI / 2 * (r1 * r1 - r0 * r0)).epsilon(1e-3));
}

}  // namespace pleat
