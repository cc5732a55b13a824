#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/contact/body_surface.h"

namespace pleat {

struct BoxSolid {
  Vec3 centre{0, 0, 0};  ///< [m]
  Vec3 size{1, 1, 1};    ///< sides along x_direction, y_direction, and both's normal [m], positive
  Vec3 x_direction{1, 0, 0};  ///< unit
  Vec3 y_direction{0, 1, 0};  ///< unit, perpendicular to it
};

struct MeshSolid {
  Positions places;                 ///< [m]
  std::vector<Triangle> triangles;  ///< closed, wound outward, not through each other
  std::string skipped;              ///< skipped statements of its file (skipped_sentence)
};

/// A solid that is met by its surface, at time 0.
struct SurfaceSolid {
  std::variant<BoxSolid, MeshSolid> shape;
  Motion motion;
  double friction = 0.3;  ///< Coulomb coefficient against the cloth, not negative

  BodySurface surface() const;
};

/// The shape where a motion has taken it.
BoxSolid placed(const BoxSolid& box, const Pose& pose);
MeshSolid placed(const MeshSolid& mesh, const Pose& pose);

}  // namespace pleat
