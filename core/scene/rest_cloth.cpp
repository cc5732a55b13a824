#include "core/scene/rest_cloth.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/refinement/mesh_match.h"
#include "core/scene/vertex_place.h"

namespace pleat {
namespace {

QuadMesh refined(const QuadCloth& cloth, int level) {
  QuadMesh quads = cloth.base_quads();
  quads.refine_uniformly(level);
  return quads;
}

/// Places and velocities of the start at this cloth's vertices: those that the start's mesh has too
/// are there, later ones in the mean of their parents, hanging ones in the middle of theirs.
void start_at(const StartState& start, const Scene& scene, RestCloth& cloth) {
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

RestCloth started(RestCloth cloth, const Scene& scene) {
  if (scene.start) start_at(*scene.start, scene, cloth);
  return cloth;
}

}  // namespace

std::optional<QuadMesh> base_quads(const Scene& scene) {
  if (const QuadCloth* cloth = scene.cloth->quads()) return cloth->base_quads();
  return std::nullopt;
}

RestCloth rest_cloth(const Scene& scene) {
  if (!scene.plan) return rest_cloth(scene, scene.level);
  const QuadCloth* cloth = scene.cloth->quads();
  PLEAT_CHECK(cloth != nullptr, "a plan refines cloth that is made of quads");
  return started(cloth->at_rest(planned_mesh(cloth->base_quads(), *scene.plan)), scene);
}

RestCloth rest_cloth(const Scene& scene, int level) {
  return started(scene.cloth->at_rest(level), scene);
}

Eigen::VectorXd rest_areas(const RestCloth& cloth) {
  if (cloth.quads) return cloth.quads->vertex_areas();
  if (cloth.given_springs) return cloth.given_springs->masses;
  return vertex_areas(cloth.mesh);
}

std::vector<GaugeEdge> gauge_edges(const RestCloth& cloth) {
  if (cloth.quads) return gauge_edges(*cloth.quads);
  if (cloth.given_springs) return gauge_edges(cloth.given_springs->springs);
  return gauge_edges(cloth.mesh);
}

std::vector<VertexId> pinned_vertices(const PinRule& rule, const RestCloth& cloth) {
  if (const auto* listed = std::get_if<std::vector<VertexId>>(&rule.where)) return *listed;
  if (const auto* name = std::get_if<std::string>(&rule.where))
    return vertices_of(cloth.groups, *name);
  return vertices_in(std::get<PinBox>(rule.where), cloth.mesh.rest_positions);
}

}  // namespace pleat
