#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Maps points of a cloth at rest to another mesh of the same cloth: meshes of different fineness
/// differ in how they follow a curved rest shape, so each point has the nearest place.
class MaterialMap {
 public:
  /// mesh    at rest, with a triangle
  /// points  of the cloth at rest [m]
  MaterialMap(const TriangleMesh& mesh, const PositionsView& points);

  /// The points' places when the mesh is at `positions` [m].
  Positions of(const PositionsView& positions) const;

  /// Normals of the triangles that the points are on, not of unit length [m^2].
  Positions normals_of(const PositionsView& positions) const;

  double farthest() const { return farthest_; }  ///< largest distance from the mesh at rest [m]

 private:
  struct Place {
    Triangle triangle;
    Vec3 weights;
  };
  std::vector<Place> places_;
  double farthest_ = 0;
};

}  // namespace pleat
