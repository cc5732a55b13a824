#include "core/scene/rest_cloth.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/smooth_surface.h"

namespace pleat {
namespace {

/// With the middles of edges whose ends are both in it.
VertexGroup refined(const VertexGroup& base, const QuadMesh& quads) {
  VertexGroup group{base.name, {}};
  std::vector<bool> inside(static_cast<std::size_t>(quads.n_vertices()), false);
  for (const VertexId v : base.vertices) inside[v] = true;
  for (int i = 0; i < quads.n_vertices(); ++i) {
    const VertexParents& parents = quads.parents()[static_cast<std::size_t>(i)];
    if (parents.count == 2) inside[i] = inside[parents.vertices[0]] && inside[parents.vertices[1]];
    if (inside[i]) group.vertices.emplace_back(i);
  }
  return group;
}

RestCloth rest_mesh(const MeshCloth& base, int level) {
  RestCloth cloth;
  std::vector<std::array<VertexId, 2>> middles;
  cloth.mesh = subdivided(base.mesh, level, &middles);
  cloth.start = cloth.mesh.rest_positions;
  const int n = base.mesh.n_vertices();
  for (const VertexGroup& group : base.groups) cloth.groups.push_back(refined(group, n, middles));
  if (base.texture_coordinates.cols() == 0) return cloth;
  cloth.rest_coordinates.resize(2, cloth.mesh.n_vertices());
  cloth.rest_coordinates.leftCols(n) = base.texture_coordinates;
  Eigen::Index column = n;
  for (const auto& [a, b] : middles)
    cloth.rest_coordinates.col(column++) =
        (cloth.rest_coordinates.col(a) + cloth.rest_coordinates.col(b)) / 2;
  return cloth;
}

/// True when a vertex at (u, v) lies in the named part of a sheet. Refinement takes exact means of
/// the borders' coordinates, so they compare equal.
bool is_in_part(SheetPart part, const SheetShape& shape, double u, double v) {
  const bool upper = u == 0;
  const bool lower = u == shape.height;
  const bool left = v == 0;
  const bool right = v == shape.width;
  switch (part) {
    case SheetPart::upper_edge:
      return upper;
    case SheetPart::lower_edge:
      return lower;
    case SheetPart::left_edge:
      return left;
    case SheetPart::right_edge:
      return right;
    case SheetPart::upper_left:
      return upper && left;
    case SheetPart::upper_right:
      return upper && right;
    case SheetPart::lower_left:
      return lower && left;
    case SheetPart::lower_right:
      return lower && right;
  }
  return false;
}

template <class IsChosen>
std::vector<VertexId> chosen(const RestCloth& cloth, IsChosen&& is_chosen) {
  std::vector<VertexId> vertices;
  for (int i = 0; i < cloth.mesh.n_vertices(); ++i)
    if (is_chosen(i)) vertices.emplace_back(i);
  return vertices;
}

}  // namespace

std::optional<QuadMesh> base_quads(const Scene& scene) {
  if (const auto* shape = std::get_if<SheetShape>(&scene.cloth)) return QuadMesh::sheet(*shape);
  if (const auto* garment = std::get_if<GarmentCloth>(&scene.cloth))
    return QuadMesh::from_patch(garment->garment.patch);
  return std::nullopt;
}

RestCloth rest_cloth(const Scene& scene) {
  if (!scene.plan) return rest_cloth(scene, scene.level);
  return rest_cloth(scene, planned_mesh(*base_quads(scene), *scene.plan));
}

RestCloth rest_cloth(const Scene& scene, int level) {
  if (std::optional<QuadMesh> quads = base_quads(scene)) {
    quads->refine_uniformly(level);
    return rest_cloth(scene, std::move(*quads));
  }
  if (const auto* mesh = std::get_if<MeshCloth>(&scene.cloth)) return rest_mesh(*mesh, level);
  const auto& particles = std::get<ParticleCloth>(scene.cloth);
  RestCloth cloth;
  cloth.mesh = {particles.positions, particles.triangles, {}};
  cloth.start = particles.positions;
  return cloth;
}

RestCloth rest_cloth(const Scene& scene, QuadMesh quads) {
  RestCloth cloth;
  cloth.mesh = quads.triangle_mesh();
  cloth.rest_coordinates = quads.rest_coordinates();
  cloth.start = cloth.mesh.rest_positions;
  if (const auto* garment = std::get_if<GarmentCloth>(&scene.cloth)) {
    cloth.start = on_smooth_surface(*base_quads(scene), quads);
    for (const VertexGroup& group : garment->garment.groups)
      cloth.groups.push_back(refined(group, quads));
  }
  cloth.quads = std::move(quads);
  return cloth;
}

Eigen::VectorXd rest_areas(const Scene& scene, const RestCloth& cloth) {
  if (cloth.quads) return cloth.quads->vertex_areas();
  if (const auto* particles = std::get_if<ParticleCloth>(&scene.cloth)) return particles->masses;
  return vertex_areas(cloth.mesh);
}

double rest_diagonal(const Scene& scene) {
  if (const auto* sheet = std::get_if<SheetShape>(&scene.cloth))
    return std::hypot(sheet->width, sheet->height);
  if (const auto* garment = std::get_if<GarmentCloth>(&scene.cloth))
    return box_diagonal(garment->garment.patch.rest_positions);
  const auto* mesh = std::get_if<MeshCloth>(&scene.cloth);
  const Positions& positions =
      mesh != nullptr ? mesh->mesh.rest_positions : std::get<ParticleCloth>(scene.cloth).positions;
  return positions.cols() == 0 ? 0 : box_diagonal(positions);
}

std::vector<VertexId> pinned_vertices(const PinRule& rule, const Scene& scene,
                                      const RestCloth& cloth) {
  if (const auto* listed = std::get_if<std::vector<VertexId>>(&rule.where)) return *listed;
  if (const auto* name = std::get_if<std::string>(&rule.where)) {
    const auto group = std::find_if(cloth.groups.begin(), cloth.groups.end(),
                                    [&](const VertexGroup& g) { return g.name == *name; });
    return group == cloth.groups.end() ? std::vector<VertexId>{} : group->vertices;
  }
  if (const auto* box = std::get_if<PinBox>(&rule.where))
    return chosen(cloth, [&](int i) { return box->holds(cloth.mesh.rest_positions.col(i)); });
  const auto& shape = std::get<SheetShape>(scene.cloth);
  const RestCoordinates& uv = cloth.rest_coordinates;
  return chosen(cloth, [&](int i) {
    return is_in_part(std::get<SheetPart>(rule.where), shape, uv(0, i), uv(1, i));
  });
}

}  // namespace pleat
