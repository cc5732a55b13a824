#include "core/scene/format/start_section.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/files/json_text.h"
#include "core/refinement/mesh_match.h"
#include "core/scene/vertex_arrays.h"

namespace pleat {

/// Finds which refinement of the cloth the start is of.
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

namespace {

StartState read_state(const JsonReader& reader, const Scene& scene) {
  reader.allow_keys({"positions_m", "velocities_m_per_s"});
  StartState start;
  start.positions = read_positions(reader.at("positions_m"));
  if (const auto at = reader.find("velocities_m_per_s")) start.velocities = read_positions(*at);
  return of_this_cloth(reader.pointer(), std::move(start), scene);
}

QuadMesh refined(const QuadCloth& cloth, int level) {
  QuadMesh quads = cloth.base_quads();
  quads.refine_uniformly(level);
  return quads;
}

}  // namespace

StartState read_start(const JsonReader& reader, const FileSource& files, const Scene& scene) {
  if (!reader.is_text()) return read_state(reader, scene);
  if (!files) reader.fail("a start written out, as no files can be read here");
  return read_named_file(reader, files, [&](const std::string& text) {
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

void begin_at(const StartState& start, const Scene& scene, RestCloth& cloth) {
  cloth.start = start.positions;
  cloth.start_velocities = start.velocities;
  if (!cloth.quads && cloth.mesh.rest_positions.cols() != start.positions.cols())
    throw InputError("/start", "expected no other refinement, as this cloth is not made of quads");
  if (!cloth.quads || cloth.quads->n_vertices() == start.positions.cols()) return;
  int level = start.level;
  for (const QuadFace& face : cloth.quads->faces()) level = std::max(level, int{face.level});
  const QuadMesh own = refined(*scene.cloth->quads(), start.level);
  const QuadMesh finer = refined(*scene.cloth->quads(), level);
  const MeshSample sample(*cloth.quads, finer);
  cloth.start = sample.of(on_finer_mesh(start.positions, own, finer));
  cloth.start_velocities = sample.of(on_finer_mesh(start.velocities, own, finer));
}

}  // namespace pleat
