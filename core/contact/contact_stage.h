#pragma once

#include <variant>
#include <vector>

#include "core/base/motion.h"
#include "core/base/shapes.h"

namespace pleat {

/// A solid that the cloth cannot enter. It may move by translation.
struct Collider {
  std::variant<Plane, Sphere> shape;  ///< its place at time 0
  Motion motion;
  double friction = 0.3;  ///< Coulomb coefficient against the cloth, not negative
};

struct ContactOptions {
  double half_thickness = 0;     ///< vertices keep at least this distance [m]
  double face_circumradius = 0;  ///< of the largest cloth triangle at rest [m]; see clearance()
};

/// Keeps the vertices of a cloth out of solids, for every stepper alike: it takes the state that a
/// substep proposes and corrects it, vertex by vertex.
///
/// The path of a vertex relative to the moving solid is swept over the substep, so that nothing
/// fast or thin is tunnelled. On impact the normal velocity relative to the solid becomes zero (no
/// bounce) and the tangential one loses at most `friction` times the normal change (Coulomb). Edges
/// and faces are covered by a sample rule: vertices are held off a sphere far enough that a flat
/// face with its corners there does not cut it (see clearance()).
class ContactStage {
 public:
  /// Throws ContractError for a radius that is not positive, a normal that is not unit, negative
  /// friction or sizes.
  ContactStage(std::vector<Collider> colliders, const ContactOptions& options);

  /// Distance from the solid's surface at which vertices are held [m]: half the thickness, and for
  /// a sphere of radius R also the sagitta sqrt(R^2 + c^2) - R of a face of circumradius c.
  double clearance(const Collider& collider) const;

  /// Places the solids at both ends of a substep [s].
  void begin_substep(double time_begin, double time_end);

  /// position_begin  where the vertex was at time_begin [m]
  /// position        where the stepper puts it at time_end [m]; corrected
  /// velocity        at time_end [m/s]; corrected
  /// Returns true when a contact acted. Never allocates.
  bool resolve(const Vec3& position_begin, Vec3& position, Vec3& velocity) const;

  const std::vector<Collider>& colliders() const { return colliders_; }
  /// The solid's shape at a time [s].
  static std::variant<Plane, Sphere> placed(const Collider& collider, double time);

 private:
  std::vector<Collider> colliders_;
  ContactOptions options_;
  std::vector<double> clearances_;   // one per collider [m]
  std::vector<Vec3> offsets_begin_;  // displacement of each collider at time_begin [m]
  std::vector<Vec3> offsets_end_;
  double duration_ = 0;  // of the substep [s]
};

}  // namespace pleat
