#include "core/scene/rest_cloth.h"

#include "core/base/check.h"
#include "core/scene/format/scene_parts.h"
#include "core/scene/vertex_place.h"

namespace pleat {
namespace {

RestCloth begun(RestCloth cloth, const Scene& scene) {
  if (scene.start) scene.start_part->begin(*scene.start, scene, cloth);
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
  return begun(cloth->at_rest(scene.plan_part->mesh(cloth->base_quads(), *scene.plan)), scene);
}

RestCloth rest_cloth(const Scene& scene, int level) {
  return begun(scene.cloth->at_rest(level), scene);
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
