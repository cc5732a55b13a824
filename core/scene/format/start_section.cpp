#include "core/scene/format/start_section.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/files/json_text.h"
#include "core/files/obj_file.h"
#include "core/scene/vertex_arrays.h"

namespace pleat {
namespace {

/// Finds of which refinement of the cloth the start is, and puts it to rest where it has no
/// velocities.
StartState of_this_cloth(const std::string& where, StartState start, const Scene& scene) {
  const std::int64_t n = start.positions.cols();
  const bool is_refinable = scene.cloth->quads() != nullptr;
  start.level = is_refinable ? 0 : scene.level;
  while (is_refinable && start.level < kMaxLevel && scene.cloth->n_vertices(start.level) < n)
    ++start.level;
  if (const std::int64_t n_expected = scene.cloth->n_vertices(start.level); n_expected != n)
    throw InputError(where, "expected a start of this cloth, which has " +
                                std::to_string(n_expected) + " vertices at level " +
                                std::to_string(start.level) + ", got " + std::to_string(n));
  if (start.velocities.cols() == 0) start.velocities.setZero(3, n);
  if (start.velocities.cols() != n)
    throw InputError(where, "expected as many velocities as positions, " + std::to_string(n) +
                                ", got " + std::to_string(start.velocities.cols()));
  return start;
}

StartState read_state(const JsonReader& reader, const Scene& scene) {
  reader.allow_keys({"positions_m", "velocities_m_per_s"});
  StartState start;
  start.positions = read_positions(reader.at("positions_m"));
  if (const auto at = reader.find("velocities_m_per_s")) start.velocities = read_positions(*at);
  return of_this_cloth(reader.pointer(), std::move(start), scene);
}

std::vector<Triangle> sorted(std::vector<Triangle> triangles) {
  for (Triangle& triangle : triangles) std::sort(triangle.begin(), triangle.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

/// The faces tell a file of this cloth from one of as many vertices in another order. A quad may be
/// cut along either diagonal.
void expect_faces_of(const Scene& scene, int level, const ObjMesh& mesh) {
  const RestCloth cloth = scene.cloth->at_rest(level);
  const std::vector<Triangle> known =
      sorted(cloth.quads ? cloth.quads->crossed_triangles() : cloth.mesh.triangles);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle face = sorted({mesh.triangles[f]}).front();
    if (!std::binary_search(known.begin(), known.end(), face))
      throw InputError(
          "line " + std::to_string(mesh.lines[f]),
          "expected a face of this cloth, got one of vertices that have none together");
  }
}

/// JSON starts with a brace, OBJ never.
StartState read_obj_start(const std::string& text, const Scene& scene) {
  const ObjMesh mesh = read_obj(text);
  StartState start = of_this_cloth("", {mesh.positions, {}, 0}, scene);
  expect_faces_of(scene, start.level, mesh);
  return start;
}

}  // namespace

StartState read_start(const JsonReader& reader, const FileSource& files, const Scene& scene) {
  if (!reader.is_text()) return read_state(reader, scene);
  if (!files) reader.fail("a start written out, as no files can be read here");
  return read_named_file(reader, files, [&](const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos || text[first] != '{') return read_obj_start(text, scene);
    const Json document = parse_json(text);
    return read_state(JsonReader(document), scene);
  });
}

Json json_start(const StartState& start) {
  Json json;
  json["positions_m"] = json_columns(start.positions);
  if (!start.velocities.isZero(0)) json["velocities_m_per_s"] = json_columns(start.velocities);
  return json;
}

}  // namespace pleat
