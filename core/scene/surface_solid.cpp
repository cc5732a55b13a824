#include "core/scene/surface_solid.h"

namespace pleat {
namespace {

BodySurface surface_of(const BoxSolid& box) {
  return box_body(box.centre, box.size, box.x_direction, box.y_direction);
}

BodySurface surface_of(const MeshSolid& mesh) { return {mesh.places, mesh.triangles, {}}; }

}  // namespace

BodySurface SurfaceSolid::surface() const {
  BodySurface surface = std::visit([](const auto& solid) { return surface_of(solid); }, shape);
  surface.motion = motion;
  surface.friction = friction;
  return surface;
}

BoxSolid placed(const BoxSolid& box, const Pose& pose) {
  return {pose * box.centre, box.size, pose.rotation * box.x_direction,
          pose.rotation * box.y_direction};
}

MeshSolid placed(const MeshSolid& mesh, const Pose& pose) {
  MeshSolid there = mesh;
  there.places = (pose.rotation * mesh.places).colwise() + pose.translation;
  return there;
}

}  // namespace pleat
