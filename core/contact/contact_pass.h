#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/contact/collider.h"
#include "core/contact/distance_budget.h"

namespace pleat {

/// Fate of the velocity with which a vertex comes down on a solid, and of the force that presses it
/// there.
enum class ContactResponse {
  resting,  ///< both end: the vertex rests on the solid
  uniform,  ///< both are turned round: the vertex bounces. For comparison.
};

struct ContactOptions {
  double half_thickness = 0;  ///< vertices keep at least this distance [m]
  /// One per vertex: the distance from a corner within which every point of the faces there lies
  /// [m], a triangle's circumradius or half of an edge's length. Empty: no face is any larger than
  /// a vertex. See clearance().
  Eigen::VectorXd face_radii;
  ContactResponse response = ContactResponse::resting;
};

/// Distance from where a solid holds it at which a vertex still counts as on it [m]: contact puts
/// vertices there to rounding, so this is generous.
constexpr double kTouchDistance = 1e-6;

/// Depth of a cloth inside of solids.
struct Penetration {
  double depth = 0;  ///< depth of the deepest below a solid's own surface [m]; 0 when none is
  VertexId deepest;  ///< invalid when none is
  int n_inside = 0;  ///< vertices inside of any solid
};

/// Keeps the vertices of a cloth out of solids, in the state that a substep proposes.
///
/// The path of a vertex relative to the moving solid is swept over the substep, so that nothing
/// fast or thin is tunnelled. From the impact on, the vertex moves in the tangent plane: its normal
/// velocity relative to the solid becomes zero (no bounce, unless the response is `uniform`), the
/// tangential one loses at most `friction` times the normal change (Coulomb), and the rest of its
/// tangential path shrinks by the same factor. A vertex that begins inside is put on the surface
/// without gaining speed. Vertices are held off a round solid far enough that a flat face with its
/// corners there does not cut it (see clearance()). Source: docs/methods/contact.md.
class ContactPass {
 public:
  /// Throws ContractError for a collider that is not valid, negative sizes.
  ContactPass(std::vector<Collider> colliders, const ContactOptions& options);

  const ContactOptions& options() const { return options_; }
  /// Throws ContractError for negative sizes.
  void set_options(const ContactOptions& options);

  /// Distance off the solid's surface at which the vertex is held [m]: half the thickness, and off
  /// a ball of radius R also the sagitta sqrt(R^2 + c^2) - R of a face of radius c; off a rounded
  /// cone that of the balls at its ends, linearly between. In a substep the sagittas of balls that
  /// are apart leave cloth half of the room between them, all round.
  Clearance clearance(const Collider& collider, VertexId vertex) const;

  /// Places the solids at both ends of a substep [s]. Throws ContractError unless time_end >
  /// time_begin.
  void begin_substep(double time_begin, double time_end);

  /// Action of a solid on a vertex. It names the solid, whose velocity is asked for anew in the
  /// substep after.
  struct Touch {
    VertexId vertex;
    int solid = -1;          ///< the last one that acted
    Vec3 normal{0, 0, 0};    ///< unit, away from it
    bool sticks = false;     ///< friction took all of the velocity across the normal
    bool in_corner = false;  ///< others acted before it
  };

  /// Corrects the whole state that a stepper proposes for the end of the substep.
  ///
  /// positions_begin  of all vertices at time_begin [m]
  /// is_exempt        for each vertex whether contact leaves it alone
  /// positions        at time_end [m]; corrected
  /// velocities       at time_end [m/s]; corrected
  /// settled          touches of vertices that a solid has acted on, in their order: they are
  ///                  on it, and met by the others alone
  ///
  /// Returns how vertices were touched, in their order; valid until the next call. One that nothing
  /// touched, or that is not finite, is left to the bit. Allocates nothing after the first call
  /// with as many vertices.
  std::span<const Touch> resolve(const PositionsView& positions_begin,
                                 std::span<const char> is_exempt, PositionsRef positions,
                                 PositionsRef velocities, std::span<const Touch> settled = {});

  /// Corrects one vertex alone, of which `resolve` of the whole state knows nothing; returns
  /// nothing where it is not touched. A touch that settled it may be null.
  std::optional<Touch> resolve(VertexId vertex, const Vec3& position_begin, Vec3& position,
                               Vec3& velocity, const Touch* settled = nullptr);

  /// The solid that a vertex meets first on its way to a place [m]; nothing where it meets none.
  std::optional<Touch> first_met(VertexId vertex, const Vec3& position_begin, const Vec3& position);

  /// A solid over the substep that was begun, as vertices are held off it.
  struct Outline {
    /// The solid itself; of a cone, and of what is not exact, a bound without a shift: no way from
    /// a to b that stays further from it than |a - b| meets the solid.
    std::variant<SweptPlane, SweptSphere> shape;
    /// True where contact brings vertices to rest on it, and it is told: by the shape, which holds
    /// all alike, or by the cone, grown by the largest clearance.
    bool is_exact = false;
    double friction = 0;
    double longest_shift = 0;         ///< way of its points in the substep, beyond drift() [m]
    const SweptCone* cone = nullptr;  ///< cone at the substep's end; valid until the next one
    std::array<double, 2> radii{};    ///< end radii of the cone without clearance [m]
    Pose carry;                       ///< the cone's motion over the substep
  };

  /// Outlines of all solids. Allocates nothing where `outlines` had as many before.
  void outlines(std::vector<Outline>& outlines) const;

  /// Mean way of rounded cones in the substep [m].
  Vec3 drift() const { return first_cone_ < solids_.size() ? budget_.drift() : Vec3::Zero(); }

  /// Factor of both ways, beyond drift(): a vertex that is further from a cone than their sum so
  /// stretched does not meet it.
  double stretch() const { return budget_.stretch(); }

  /// Touches of the last call of resolve, in the order of the vertices.
  std::span<const Touch> touches() const { return touches_; }

  /// Least height above where solids hold them of the vertices that are not exempt, at the end of
  /// the substep [m]; negative below, infinite without solids.
  double least_gap(const PositionsView& positions, std::span<const char> is_exempt) const;

  /// Mean velocity over the substep of the touched solid's point that is at a place [m] when it
  /// begins [m/s].
  Vec3 solid_velocity(const Touch& touch, const Vec3& place_begin) const;

  /// Distance of this place [m] from where the touched solid holds the vertex when the substep
  /// ends; negative below.
  Gap gap_at_end(const Touch& touch, const Vec3& place) const;

  /// Number of times since construction that solids closed in on a vertex from sides so opposed, or
  /// so many, that it was left inside one of them.
  std::int64_t n_unresolved() const { return n_unresolved_; }

  /// Depth of the vertices inside of the solids as these are at a time [s], clearance not counted.
  Penetration penetration(const PositionsView& positions, double time) const;

  /// A vertex on a solid that may push it and rub at it.
  struct Support {
    VertexId vertex;
    Vec3 normal{0, 0, 0};  ///< unit, away from the solid
    double friction = 0;   ///< Coulomb coefficient
    int solid = -1;        ///< index among colliders()
    double height = 0;     ///< distance from where the solid holds it [m]; negative below
  };

  /// The vertices that are at a time [s] within this height [m] above where a solid holds them;
  /// once for each solid. It knows positions alone, and nothing of substeps.
  std::vector<Support> supports(const PositionsView& positions, double time,
                                double within = kTouchDistance) const;

  /// Size of its solids and of the radii of faces, without what it keeps of touches.
  std::size_t bytes() const;

  /// Rounded cones come last.
  const std::vector<Collider>& colliders() const { return colliders_; }
  /// The solid's shape at a time [s].
  static SolidShape placed(const Collider& collider, double time) {
    return pleat::placed(collider.shape, collider.motion.pose(time));
  }

 private:
  struct Roundness {
    std::array<double, 2> radii{};  ///< end_radii [m]
    /// The largest sagitta that leaves the gaps to other solids open [m].
    double most_sagitta = std::numeric_limits<double>::infinity();
  };
  /// A collider over the substep that was begun.
  struct Solid {
    SweptSolid swept;  ///< grown by the largest clearance
    Roundness roundness;
    double friction = 0;
    Vec3 velocity{0, 0, 0};  ///< mean over the substep [m/s], of one that does not turn
    bool turns = false;      ///< then its shift is zero, and all is seen from where it ends:
    Pose carry;              ///< its motion over the substep,
    Pose back;               ///< its inverse
  };
  struct Meeting {
    const Solid* solid = nullptr;  ///< null when nothing is met
    Impact impact;

    void keep_earlier(const Solid& other, const std::optional<Impact>& met);
  };

  Clearance clearance(const Roundness& solid, double face_radius) const;
  double face_radius(VertexId vertex) const;
  void find_gaps();
  double most_sagitta(std::size_t ball, std::span<const Pose> poses) const;
  template <class Shape, class Action>
  auto with_held(const Solid& solid, const Shape& shape, VertexId vertex,
                 const Action& action) const;
  Gap held_gap(const Solid& solid, VertexId vertex, const Vec3& place) const;
  double bare_height(const Solid& solid, const Vec3& place) const;
  bool grips(const Solid& a, const Solid& b, const Vec3& place) const;
  Vec3 velocity_at(const Solid& solid, const Vec3& place) const;
  static Vec3 relative_path(const Solid& solid, const Vec3& begin, const Vec3& end);
  void make_budget();
  void place(const Collider& collider, const Pose& begin, const Pose& end, Solid& solid) const;
  void meet_framed(VertexId vertex, const Vec3& begin, const Vec3& end, double slack,
                   const Solid* skipped, Meeting& earliest);
  Meeting earliest_meeting(VertexId vertex, const Vec3& begin, const Vec3& end, double slack,
                           const Solid* skipped);

  std::vector<Collider> colliders_;  // rounded cones last
  std::size_t first_framed_ = 0;     // planes and spheres that do not turn come before it
  std::size_t first_cone_ = 0;
  ContactOptions options_;
  double largest_face_radius_ = 0;  // [m]
  bool is_graded_ = false;          // vertices differ in it
  /// Indices of a ball and of another one that is apart from it at the start.
  std::vector<std::array<std::size_t, 2>> gaps_;
  double substep_ = 0;             // [s]
  std::vector<Solid> solids_;      // one per collider
  std::vector<Pose> poses_begin_;  // one per collider
  std::vector<Pose> poses_end_;
  DistanceBudget budget_;       // budget of the rounded cones
  std::vector<Touch> touches_;  // answers of the last call of resolve
  std::int64_t n_unresolved_ = 0;
};

}  // namespace pleat
