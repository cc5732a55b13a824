#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/fabric/spring_lattice.h"
#include "core/mesh/triangle_mesh.h"
#include "core/model/state.h"

namespace pleat {

/// Change of curvature within which the friction of bent cloth is elastic [1/m]: a twentieth of the
/// 100 1/m at which 2HB is read, so that loops of that amplitude have their measured width to the
/// full. Cloth that swings by less bends back without loss, and stiffer: by (2HB/2)/this.
constexpr double kPreSlidingCurvature = 5;

/// Friction inside bent cloth: threads that rub resist each change of curvature by a moment per
/// width of 2HB/2 at most, beside the elastic one. Along mesh lines, with kappa the curvature
/// across the surface,
///
///     M = B_f e,  e = kappa - kappa_slip,  |e| <= e_y = kPreSlidingCurvature,  B_f = (2HB/2)/e_y:
///
/// elastic until it slips, a sharp knee. Within a substep it has a convex potential,
/// w L B_f (e^2/2, beyond the knee e_y (|e| - e_y/2)), whose part beyond what is stored is lost.
/// The moment is state of the cloth, as places and velocities are.
///
/// Curvature is linear in places: taken along the normals that the surface will have in the middle
/// of the substep, so that turning cloth keeps its moments. Where it has no normal, moments wait.
/// Sources: docs/methods/inner_friction.md; Miguel, Tamstorf, Bradley, Schvartzman, Thomaszewski,
/// Bickel, Matusik, Marschner & Otaduy, Modeling and estimation of internal friction in cloth, ACM
/// Transactions on Graphics 32(6), 2013; Dahl, A solid friction model, Aerospace Corporation, 1968.
class BendFriction {
 public:
  /// Friction where three vertices follow each other on a mesh line.
  struct Element {
    BendElement bend;         ///< its stiffness: B_f w L [N m^3]
    Vec3 normal{0, 0, 0};     ///< unit normal of the surface, or zero
    double strain = 0;        ///< e at the last evaluation [1/m]
    double curvature = 0;     ///< curvature along the normal, there [1/m]
    double share = 1;         ///< share of the stiffness, within a substep
    std::uint64_t place = 0;  ///< tells its three vertices at rest from others
  };

  /// How a substep takes the knee.
  enum class Knee {
    exact,      ///< the potential itself, at the end of the substep
    in_middle,  ///< the potential in the middle of the substep
    /// Its secant through the strain to which the present velocities lead: a parabola that touches
    /// the potential there and is nowhere below it, for one linear solve.
    foreseen,
  };

  /// bends           of rigidity 1: stiffness is width times length [m^2]
  /// hysteresis      2HB [N], positive
  /// surface         triangles wound alike
  /// rest_positions  one column per vertex; where the moments are zero, too, until `restart`
  BendFriction(std::vector<BendElement> bends, double hysteresis, std::vector<Triangle> surface,
               const Positions& rest_positions);

  /// Cloth without moments at these places.
  void restart(const Positions& positions);
  /// Moments of another cloth, or of this one before its mesh changed, where the same three
  /// vertices follow each other; none elsewhere, and none larger than this cloth's.
  void take_moments(const BendFriction& other, const Positions& positions);

  /// Copy of the state, for `restore`.
  struct Kept {
    std::vector<double> strains;  ///< one per element [1/m]
    double dissipated = 0;        ///< [J]
  };
  void keep(Kept& kept) const;
  void restore(const Kept& kept, const Positions& positions);

  /// Starts a substep: until end_substep energy and forces are those of the substep.
  void begin_substep(const State& state, double h, Knee knee);
  /// Slips to these places. No more is stored than moments did work, so that cloth never gains.
  void end_substep(const Positions& positions);

  /// Energy [J]; at the places of the last evaluation it is what is stored.
  double energy(const PositionsView& positions) const;
  void add_forces(const PositionsView& positions, PositionsRef forces) const;
  /// The second derivative of an element's energy by its curvature, never negative [N m^3].
  double tangent(const Element& element, const PositionsView& positions) const;

  std::span<const Element> elements() const { return elements_; }
  /// Lost by slipping since the start [J].
  double dissipated() const { return dissipated_; }
  std::size_t bytes() const;

 private:
  void find_curvatures(const Positions& positions, const Positions& places_of_normals);
  double bent(const Element& element, const PositionsView& positions) const;

  std::vector<Element> elements_;
  std::vector<Triangle> surface_;
  double rigidity_;   // B_f [N m]
  double knee_;       // |e| from which on the moment stays; infinite where it is foreseen [1/m]
  double reach_ = 1;  // share of the way at which a substep takes its moments
  double dissipated_ = 0;  // [J]
  Positions normals_;
  Positions middle_;  // places in the middle of the substep
};

}  // namespace pleat
