#include "core/scene/cloth_section.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/mesh/mesh_lines.h"
#include "core/scene/garment_cloth.h"
#include "core/scene/mesh_cloth.h"
#include "core/scene/vertex_arrays.h"

namespace pleat {
namespace {

constexpr std::int64_t kMaxCells = kMaxVertices;  // along one side; the product is checked too

std::int64_t n_sheet_vertices(const SheetShape& shape, int level) {
  const std::int64_t cells_per_side = std::int64_t{1} << level;
  return (shape.columns * cells_per_side + 1) * (shape.rows * cells_per_side + 1);
}

/// Each level puts a vertex on every edge, halves the edge and joins the three of each triangle.
std::int64_t n_mesh_vertices(const TriangleMesh& mesh, int level) {
  std::int64_t n_vertices = mesh.n_vertices();
  auto n_triangles = static_cast<std::int64_t>(mesh.triangles.size());
  auto n_edges = static_cast<std::int64_t>(level > 0 ? mesh_edges(mesh.triangles).size() : 0);
  for (; level > 0; --level) {
    n_vertices += n_edges;
    n_edges = 2 * n_edges + 3 * n_triangles;
    n_triangles *= 4;
  }
  return n_vertices;
}

/// Each level puts a vertex on every edge and in every face; an edge becomes two, a face four with
/// four edges between.
std::int64_t n_garment_vertices(const QuadPatch& patch, int level) {
  std::int64_t n_vertices = patch.rest_positions.cols();
  auto n_faces = static_cast<std::int64_t>(patch.quads.size());
  auto n_edges = static_cast<std::int64_t>(thread_edges(QuadMesh::from_patch(patch)).edges.size());
  for (; level > 0; --level) {
    n_vertices += n_edges + n_faces;
    n_edges = 2 * n_edges + 4 * n_faces;
    n_faces *= 4;
  }
  return n_vertices;
}

/// Directions that are perpendicular up to the digits of a file are made so to the last bit.
void read_directions(const JsonReader& reader, SheetShape& shape) {
  constexpr double kWrittenDigits = 1e-6;  // cosine; a file with six digits is meant perpendicular
  constexpr double kRoundedDigits =
      1e-14;  // cosine; kept to the bit, so that what was written is read back
  if (const auto at = reader.find("warp_direction")) shape.warp_direction = at->direction();
  if (const auto at = reader.find("weft_direction")) shape.weft_direction = at->direction();
  const double cosine = shape.warp_direction.dot(shape.weft_direction);
  if (std::abs(cosine) > kWrittenDigits)
    throw InputError(reader.pointer() + "/weft_direction",
                     "expected a direction perpendicular to warp_direction, got one at " +
                         Json(std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / M_PI).dump() +
                         " degrees");
  if (std::abs(cosine) > kRoundedDigits)
    shape.weft_direction = (shape.weft_direction - cosine * shape.warp_direction).normalized();
}

void read_sheet(const JsonReader& reader, Scene& scene) {
  reader.allow_keys({"width_m", "height_m", "columns", "rows", "origin_m", "warp_direction",
                     "weft_direction", "initial_velocity_m_per_s"});
  SheetShape shape;
  if (const auto at = reader.find("width_m")) shape.width = at->number(kPositive);
  if (const auto at = reader.find("height_m")) shape.height = at->number(kPositive);
  if (const auto at = reader.find("columns"))
    shape.columns = static_cast<int>(at->integer(1, kMaxCells));
  if (const auto at = reader.find("rows")) shape.rows = static_cast<int>(at->integer(1, kMaxCells));
  if (const auto at = reader.find("origin_m")) shape.origin = at->vec3();
  read_directions(reader, shape);
  if (const auto at = reader.find("initial_velocity_m_per_s")) scene.initial_velocity = at->vec3();
  const std::int64_t n_vertices = n_sheet_vertices(shape, 0);
  if (n_vertices > kMaxVertices)
    throw InputError(reader.pointer(), "expected at most " + std::to_string(kMaxVertices) +
                                           " vertices, got " + std::to_string(n_vertices));
  scene.cloth = shape;
}

Spring read_spring(const JsonReader& reader, const Positions& positions) {
  reader.allow_keys({"a", "b", "stiffness_n_per_m", "rest_length_m", "damping_n_s_per_m"});
  Spring spring;
  spring.a = read_vertex(reader.at("a"), positions.cols());
  spring.b = read_vertex(reader.at("b"), positions.cols());
  if (spring.a == spring.b) reader.at("b").fail("a particle other than a");
  spring.stiffness = reader.at("stiffness_n_per_m").number(kPositive);
  spring.rest_length = (positions.col(spring.a) - positions.col(spring.b)).norm();
  if (const auto at = reader.find("rest_length_m")) spring.rest_length = at->number(kNotNegative);
  if (const auto at = reader.find("damping_n_s_per_m")) spring.damping = at->number(kNotNegative);
  return spring;
}

BendElement read_bend(const JsonReader& reader, std::int64_t n_vertices) {
  constexpr double kRounding = 1e-9;  // of the largest weight; a file may round its weights
  reader.allow_keys({"vertices", "stiffness_n_m3", "weights_per_m2"});
  BendElement bend;
  bend.vertices = read_vertices<3>(reader.at("vertices"), n_vertices);
  bend.stiffness = reader.at("stiffness_n_m3").number(kPositive);
  const JsonReader weights = reader.at("weights_per_m2");
  const Vec3 read = weights.vec3();
  if (std::abs(read.sum()) > kRounding * read.cwiseAbs().maxCoeff())
    throw InputError(weights.pointer(),
                     "expected weights that sum to zero, got a sum of " + Json(read.sum()).dump());
  bend.weights = {read[0], read[1], read[2]};
  return bend;
}

void read_particles(const JsonReader& reader, Scene& scene) {
  reader.allow_keys(
      {"positions_m", "velocities_m_per_s", "masses_kg", "springs", "bends", "triangles"});
  ParticleCloth cloth;
  cloth.positions = read_positions(reader.at("positions_m"));
  const std::int64_t n = cloth.positions.cols();
  const auto n_elements = static_cast<std::size_t>(n);
  cloth.velocities = Positions::Zero(3, n);
  if (const auto at = reader.find("velocities_m_per_s"))
    cloth.velocities = read_columns(at->elements(n_elements));
  cloth.masses.resize(n);
  Eigen::Index particle = 0;
  for (const JsonReader& mass : reader.at("masses_kg").elements(n_elements))
    cloth.masses[particle++] = mass.number(kPositive);
  if (const auto at = reader.find("springs"))
    for (const JsonReader& spring : at->elements())
      cloth.springs.push_back(read_spring(spring, cloth.positions));
  if (const auto at = reader.find("bends"))
    for (const JsonReader& bend : at->elements()) cloth.bends.push_back(read_bend(bend, n));
  if (const auto at = reader.find("triangles"))
    for (const JsonReader& triangle : at->elements())
      cloth.triangles.push_back(read_vertices<3>(triangle, n));
  scene.cloth = std::move(cloth);
}

// Key by key, as write_scene does.
Json json_sheet(const SheetShape& shape, const Vec3& initial_velocity) {
  Json json;
  json["width_m"] = shape.width;
  json["height_m"] = shape.height;
  json["columns"] = shape.columns;
  json["rows"] = shape.rows;
  json["origin_m"] = json_vec3(shape.origin);
  json["warp_direction"] = json_vec3(shape.warp_direction);
  json["weft_direction"] = json_vec3(shape.weft_direction);
  json["initial_velocity_m_per_s"] = json_vec3(initial_velocity);
  return json;
}

Json json_spring(const Spring& spring) {
  Json json;
  json["a"] = spring.a.value;
  json["b"] = spring.b.value;
  json["stiffness_n_per_m"] = spring.stiffness;
  json["rest_length_m"] = spring.rest_length;
  json["damping_n_s_per_m"] = spring.damping;
  return json;
}

Json json_bend(const BendElement& bend) {
  Json json;
  json["vertices"] = json_vertices(bend.vertices);
  json["stiffness_n_m3"] = bend.stiffness;
  json["weights_per_m2"] = bend.weights;
  return json;
}

Json json_particles(const ParticleCloth& cloth) {
  Json json;
  json["positions_m"] = json_columns(cloth.positions);
  json["velocities_m_per_s"] = json_columns(cloth.velocities);
  json["masses_kg"] = Json::array();
  for (const double mass : cloth.masses) json["masses_kg"].push_back(mass);
  json["springs"] = Json::array();
  for (const Spring& spring : cloth.springs) json["springs"].push_back(json_spring(spring));
  json["bends"] = Json::array();
  for (const BendElement& bend : cloth.bends) json["bends"].push_back(json_bend(bend));
  json["triangles"] = Json::array();
  for (const Triangle& triangle : cloth.triangles)
    json["triangles"].push_back(json_vertices(triangle));
  return json;
}

}  // namespace

std::int64_t n_refined_vertices(const Scene& scene, int level) {
  if (const auto* shape = std::get_if<SheetShape>(&scene.cloth))
    return n_sheet_vertices(*shape, level);
  if (const auto* cloth = std::get_if<MeshCloth>(&scene.cloth))
    return n_mesh_vertices(cloth->mesh, level);
  if (const auto* garment = std::get_if<GarmentCloth>(&scene.cloth))
    return n_garment_vertices(garment->garment.patch, level);
  return std::get<ParticleCloth>(scene.cloth).positions.cols();
}

void check_level(const Scene& scene, int level, const std::string& where) {
  if (level > 0 && std::holds_alternative<ParticleCloth>(scene.cloth))
    throw InputError(where,
                     "expected 0, as particles cannot be refined, got " + std::to_string(level));
  const std::int64_t n_vertices = n_refined_vertices(scene, level);
  if (n_vertices > kMaxVertices)
    throw InputError(where, "expected a level with at most " + std::to_string(kMaxVertices) +
                                " vertices, got " + std::to_string(level) + " with " +
                                std::to_string(n_vertices));
}

void read_cloth(const JsonReader& reader, const FileSource& files, Scene& scene) {
  reader.allow_keys({"sheet", "particles", "mesh", "garment"});
  switch (reader.only_one_of({"sheet", "particles", "mesh", "garment"})) {
    case 0:
      return read_sheet(reader.at("sheet"), scene);
    case 1:
      return read_particles(reader.at("particles"), scene);
    case 2:
      return read_mesh(reader.at("mesh"), files, scene);
    default:
      scene.cloth = read_garment(reader.at("garment"), scene);
  }
}

Json json_cloth(const Scene& scene) {
  Json json;
  if (const auto* shape = std::get_if<SheetShape>(&scene.cloth))
    json["sheet"] = json_sheet(*shape, scene.initial_velocity);
  if (const auto* cloth = std::get_if<MeshCloth>(&scene.cloth))
    json["mesh"] = json_mesh(*cloth, scene.initial_velocity);
  if (const auto* garment = std::get_if<GarmentCloth>(&scene.cloth))
    json["garment"] = json_garment(*garment);
  if (const auto* particles = std::get_if<ParticleCloth>(&scene.cloth))
    json["particles"] = json_particles(*particles);
  return json;
}

}  // namespace pleat
