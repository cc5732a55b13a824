#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "core/base/motion.h"
#include "core/base/shapes.h"
#include "core/contact/swept_contact.h"

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
/// fast or thin is tunnelled. From the impact on, the vertex moves in the tangent plane: its normal
/// velocity relative to the solid becomes zero (no bounce), the tangential one loses at most
/// `friction` times the normal change (Coulomb), and the rest of its tangential path shrinks by the
/// same factor. A vertex that begins inside is put on the surface without gaining speed. Edges and
/// faces are covered by a sample rule: vertices are held off a sphere far enough that a flat face
/// with its corners there does not cut it (see clearance()). Source: docs/methods/contact.md
/// (derivation and limits).
class ContactStage {
 public:
  /// Throws ContractError for a radius that is not positive, a normal that is not unit, negative
  /// friction or sizes.
  ContactStage(std::vector<Collider> colliders, const ContactOptions& options);

  const ContactOptions& options() const { return options_; }
  /// Throws ContractError for negative sizes.
  void set_options(const ContactOptions& options);

  /// Distance from the solid's surface at which vertices are held [m]: half the thickness, and for
  /// a sphere of radius R also the sagitta sqrt(R^2 + c^2) - R of a face of circumradius c.
  double clearance(const Collider& collider) const;

  /// Places the solids at both ends of a substep [s]. Throws ContractError unless time_end >
  /// time_begin.
  void begin_substep(double time_begin, double time_end);

  /// position_begin  where the vertex was at time_begin [m]
  /// position        where the stepper puts it at time_end [m]; corrected
  /// velocity        at time_end [m/s]; corrected
  /// Returns true when a contact acted. Never allocates. A vertex that is not finite is left as it
  /// is.
  bool resolve(const Vec3& position_begin, Vec3& position, Vec3& velocity);

  /// How often, since construction, solids closed in on a vertex from sides so opposed, or so many,
  /// that it was left inside one of them.
  std::int64_t n_unresolved() const { return n_unresolved_; }

  const std::vector<Collider>& colliders() const { return colliders_; }
  /// The solid's shape at a time [s].
  static std::variant<Plane, Sphere> placed(const Collider& collider, double time);

 private:
  /// A collider over the substep that was begun.
  struct Solid {
    std::variant<SweptPlane, SweptSphere> swept;
    Vec3 velocity{0, 0, 0};  ///< mean over the substep [m/s]
    double friction = 0;
  };
  struct Meeting {
    const Solid* solid = nullptr;  ///< null when nothing is met
    Impact impact;
  };

  Meeting earliest_meeting(const Vec3& begin, const Vec3& end, double slack,
                           const Solid* skipped) const;

  std::vector<Collider> colliders_;
  ContactOptions options_;
  std::vector<Solid> solids_;  // one per collider
  std::int64_t n_unresolved_ = 0;
};

}  // namespace pleat
