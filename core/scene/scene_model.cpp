#include "core/scene/scene_model.h"

#include <algorithm>
#include <cmath>

namespace pleat {
namespace {

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

std::vector<VertexId> chosen_vertices(const PinRule& rule, const Scene& scene,
                                      const QuadMesh* mesh) {
  if (const auto* listed = std::get_if<std::vector<VertexId>>(&rule.where)) return *listed;
  std::vector<VertexId> vertices;
  const auto& shape = std::get<SheetShape>(scene.cloth);
  const RestCoordinates& uv = mesh->rest_coordinates();
  for (int i = 0; i < mesh->n_vertices(); ++i)
    if (is_in_part(std::get<SheetPart>(rule.where), shape, uv(0, i), uv(1, i)))
      vertices.emplace_back(i);
  return vertices;
}

/// A later rule does not pin again what an earlier one holds.
std::vector<Pin> scene_pins(const Scene& scene, const QuadMesh* mesh, const Positions& positions) {
  std::vector<Pin> pins;
  std::vector<bool> pinned(static_cast<std::size_t>(positions.cols()), false);
  for (const PinRule& rule : scene.pins) {
    for (const VertexId v : chosen_vertices(rule, scene, mesh)) {
      if (pinned[v]) continue;
      pinned[v] = true;
      pins.push_back({v, positions.col(v), rule.motion});
    }
  }
  return pins;
}

/// Of the largest triangle [m].
double largest_circumradius(const std::vector<Triangle>& triangles, const Positions& positions) {
  double largest = 0;
  for (const Triangle& t : triangles) {
    const Vec3 a = positions.col(t[1]) - positions.col(t[0]);
    const Vec3 b = positions.col(t[2]) - positions.col(t[0]);
    const double doubled_area = a.cross(b).norm();
    if (doubled_area > 0)
      largest = std::max(largest, a.norm() * b.norm() * (a - b).norm() / (2 * doubled_area));
  }
  return largest;
}

void fill_sheet(ClothModel& model, const Scene& scene, const QuadMesh& mesh) {
  SpringLattice lattice = spring_lattice(mesh, scene.fabric);
  model.masses = std::move(lattice.masses);
  model.springs = std::move(lattice.springs);
  if (scene.model.bending == BendingModel::quadratic) model.bends = std::move(lattice.bends);
  if (!scene.model.shear)
    model.springs.erase(
        std::remove_if(model.springs.begin(), model.springs.end(),
                       [](const Spring& spring) { return spring.kind == SpringKind::shear; }),
        model.springs.end());
  model.rest_coordinates = mesh.rest_coordinates();
}

}  // namespace

std::optional<QuadMesh> scene_mesh(const Scene& scene) {
  const auto* shape = std::get_if<SheetShape>(&scene.cloth);
  if (!shape) return std::nullopt;
  QuadMesh mesh = QuadMesh::sheet(*shape);
  mesh.refine_uniformly(scene.level);
  return mesh;
}

State scene_state(const Scene& scene, const QuadMesh* mesh) {
  if (const auto* particles = std::get_if<InlineCloth>(&scene.cloth))
    return {particles->positions, particles->velocities};
  return {mesh->rest_positions(), scene.initial_velocity.replicate(1, mesh->n_vertices())};
}

ClothModel scene_model(const Scene& scene, const QuadMesh* mesh,
                       const std::vector<Triangle>& triangles) {
  ClothModel model;
  if (const auto* particles = std::get_if<InlineCloth>(&scene.cloth)) {
    model.masses = particles->masses;
    model.springs = particles->springs;
    if (scene.model.bending == BendingModel::quadratic) model.bends = particles->bends;
  } else {
    fill_sheet(model, scene, *mesh);
  }
  const Positions positions = scene_state(scene, mesh).positions;
  model.damping_direction = scene.model.damping_direction;
  model.gravity = scene.gravity;
  model.pins = scene_pins(scene, mesh, positions);
  // A sheet's quads are split both ways, so that drag is shared among corners as mass is.
  if (scene.air && mesh)
    model.air.emplace(mesh->crossed_triangles(), *scene.air, model.n_vertices(), 0.5);
  else if (scene.air && !triangles.empty())
    model.air.emplace(triangles, *scene.air, model.n_vertices());
  if (!scene.colliders.empty()) {
    const ContactOptions options{scene.fabric.thickness / 2,
                                 largest_circumradius(triangles, positions)};
    model.contact.emplace(scene.colliders, options);
  }
  return model;
}

BuildReport build_report(const ClothModel& model) {
  BuildReport report;
  const auto note = [&report](bool built, const char* part) {
    (built ? report.built : report.left_out).emplace_back(part);
  };
  note(!model.springs.empty(), "springs");
  note(std::any_of(model.springs.begin(), model.springs.end(),
                   [](const Spring& s) { return s.damping > 0; }),
       "dampers");
  note(!model.bends.empty(), "bending");
  note(!model.gravity.isZero(), "gravity");
  note(!model.pins.empty(), "pins");
  note(model.air.has_value(), "air drag");
  note(model.contact.has_value(), "contact");
  return report;
}

}  // namespace pleat
