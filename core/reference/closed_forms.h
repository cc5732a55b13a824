#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

namespace pleat {

// Shapes at rest under weight, each from an equation of its own that shares no code with the
// steppers. Derivations: docs/methods/closed_forms.md.

/// An inextensible strip clamped horizontally at one end.
struct Cantilever {
  double length = 1;    ///< free [m], positive
  double weight = 0;    ///< weight per area [N/m^2], not negative
  double rigidity = 1;  ///< B, per width [N m], positive

  double load() const { return weight * length * length * length / rigidity; }  ///< w L^3/B
};

/// Largest Cantilever::load that heavy_elastica takes: beyond it the tip's angle from straight
/// down, near exp(-2/3 sqrt(load)), leaves the range of numbers.
constexpr double kMaxCantileverLoad = 1e6;

/// The heavy elastica, to 1e-10 of its length.
///
/// arc_lengths  from the clamp, in [0, length] [m]
/// Returns a column for each: distance from the clamp, depth below it [m].
///
/// Throws ContractError when a promise is broken.
/// Source: Bickley, The heavy elastica, Philosophical Magazine 17, 1934.
Eigen::Matrix2Xd heavy_elastica(const Cantilever& strip, std::span<const double> arc_lengths);

/// A limp rope with a weight.
struct Rope {
  double length = 1;      ///< unstretched [m], positive
  double weight = 1;      ///< weight per unstretched length [N/m], positive
  double compliance = 0;  ///< strain per tension [1/N], not negative; 0: inextensible
};

/// The elastic catenary between two supports, to 1e-12 of its length or its span, whichever is
/// larger.
///
/// far_support  from the first support: sideways, positive, and down [m]
/// arc_lengths  unstretched, from the first support, in [0, length] [m]
/// Returns a column for each: sideways and down from the first support [m]; nothing when the
/// equation could not be solved that well.
///
/// Throws ContractError when a promise is broken, or an inextensible rope does not reach.
/// Source: Irvine, Cable Structures, MIT Press 1981.
std::optional<Eigen::Matrix2Xd> catenary(const Rope& rope, const Eigen::Vector2d& far_support,
                                         std::span<const double> arc_lengths);

/// A linear spring and the weight at its far end.
struct ChainLink {
  double length = 0;     ///< rest length [m], not negative
  double stiffness = 1;  ///< [N/m], positive
  double weight = 0;     ///< [N], not negative
};

/// Nodes of a chain of springs at rest between two supports: the elastic catenary of a chain, with
/// the same accuracy for any number of links. The last weight rests on the far support.
///
/// Arguments and results as for `catenary`, one column per node, the first support among them.
/// Throws ContractError unless a link's weight other than the last is positive.
std::optional<Eigen::Matrix2Xd> chain_between_supports(std::span<const ChainLink> links,
                                                       const Eigen::Vector2d& far_support);

/// Depths of the same nodes when the chain hangs from its first support alone [m].
Eigen::VectorXd hanging_chain(std::span<const ChainLink> links);

enum class StretchLaw {
  hooke,  ///< N = K (F - 1): springs
  green,  ///< N = F K (F^2 - 1)/2: St. Venant-Kirchhoff
};

/// A strip that hangs under its own weight, free to keep its width.
struct HangingStrip {
  double length = 1;                   ///< rest length [m], positive
  double weight = 0;                   ///< weight per rest area [N/m^2], not negative
  double stiffness = 1;                ///< K, per width [N/m], positive
  StretchLaw law = StretchLaw::hooke;  ///< force per width N at the stretch F
};

/// Depth of the material point that at rest is `rest_depth` below the upper edge [m], to rounding.
double hanging_depth(const HangingStrip& strip, double rest_depth);

}  // namespace pleat
