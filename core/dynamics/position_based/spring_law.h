#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "core/dynamics/method_options.h"
#include "core/dynamics/position_based/lane_operations.h"
#include "core/model/cloth_model.h"

namespace pleat {

/// How a spring pulls. Its damper is no part of that: see DamperProgram.
enum class SpringLaw {
  rigid,          ///< keeps its rest length whatever the force
  rigid_threads,  ///< rigid, but diagonals of quads are corrected in part at a time
  elastic,        ///< pulls by its stiffness
};

constexpr bool is_rigid(SpringLaw law) {
  return law == SpringLaw::rigid || law == SpringLaw::rigid_threads;
}

/// The law of springs as such constraints.
SpringLaw spring_law(Constraints constraints);

/// Calls work(constant) with the law as a compile-time constant: `rigid` for all that are, which
/// differ in the numbers of a SpringBlock alone.
template <class Work>
auto with_law(SpringLaw law, Work&& work) {
  switch (law) {
    case SpringLaw::elastic:
      return work(std::integral_constant<SpringLaw, SpringLaw::elastic>());
    case SpringLaw::rigid:
    case SpringLaw::rigid_threads:
      break;
  }
  return work(std::integral_constant<SpringLaw, SpringLaw::rigid>());
}

/// The springs of a model that can pull at all, and those of them that join no hanging vertex.
std::vector<int> active_springs(const ClothModel& model);
std::vector<int> free_springs(const ClothModel& model);

/// A bending element as one vector constraint, C = sum of weights times places.
struct BendConstraint {
  std::array<VertexId, 3> vertices;  ///< the one before, the middle one, the one after
  std::array<double, 3> weights;     ///< shares of the middle one's size
  float compliance;                  ///< mean mass / (stiffness h^2)
};

/// The bending elements of a model that resist, for substeps of h [s].
std::vector<BendConstraint> bend_constraints(const ClothModel& model, double h);

/// True where one of the vertices hangs.
template <class Vertices>
bool any_hangs(const ClothModel& model, const Vertices& vertices) {
  return std::any_of(vertices.begin(), vertices.end(),
                     [&model](VertexId v) { return model.hangs(v); });
}

/// Least square of a length that may be zero [m^2].
constexpr float kTinySquare = 1e-30f;

/// The numbers of four springs.
struct SpringBlock {
  PerLane<float> rest{1, 1, 1, 1};  ///< L [m]; for the rigid law L^2 [m^2]
  PerLane<float> compliance{};      ///< mean mass / (stiffness h^2); 0 in empty lanes
  /// Compliance in denominators; infinite in empty lanes: nothing moves there.
  PerLane<float> denominator_share{kEmptyLane, kEmptyLane, kEmptyLane, kEmptyLane};
  bool operator==(const SpringBlock&) const = default;

  /// h          substep [s]
  /// mean_mass  of the model's vertices [kg]
  void set_lane(std::size_t lane, const Spring& spring, SpringLaw law, double h, double mean_mass);
};

// With d = x_a - x_b at the end of the substep and d_begin at its start, the pull acts along their
// mean, of which g = d + d_begin is twice: all of it along d damps, less than half along d is not
// stable under high tension (docs/methods/xpbd.md). Corrections x_a += w_a f g, x_b -= w_b f g
// change the length l = |d| by f (w_a + w_b) d.g/l.
//   rigid:   (l^2 - L^2)/2 + f (w_a + w_b) d.g = 0
//   elastic: l - L + alpha lambda = 0, with lambda the multiplier and dlambda = f d.g/l; times l
// Both read aim = f slope (w_a + w_b + alpha), slope = d.g. The slope, 2 l^2 when nothing turns, is
// held above L^2 or l^2: below, the spring turned by more than 60 degrees within a substep or is
// squeezed to nothing, and the linearisation would throw it far over its aim.
template <class Lanes>
struct Linearised {
  Vec3Lanes<Lanes> d, g;
  Lanes aim, slope;
  Lanes length;  // elastic law only
};

template <class Lanes, SpringLaw law, bool first>
Linearised<Lanes> linearise(const Vec3Lanes<Lanes>& d_begin, const Vec3Lanes<Lanes>& change_of_d,
                            const SpringBlock& block, int lane, const float* multiplier) {
  Linearised<Lanes> spring;
  spring.d = d_begin + change_of_d;
  spring.g = spring.d + d_begin;
  const Lanes square = dot(spring.d, spring.d);
  const Lanes rest = Lanes::load(block.rest.data() + lane);
  if constexpr (law == SpringLaw::rigid) {
    spring.aim = Lanes::all(0.5f) * (rest - square);
    spring.slope = max(dot(spring.d, spring.g), max(rest, square));
  } else {
    const Lanes tiny = Lanes::all(kTinySquare);
    spring.length = sqrt(max(square, tiny));
    Lanes error = rest - spring.length;
    if constexpr (!first)
      error = error - Lanes::load(block.compliance.data() + lane) * Lanes::load(multiplier);
    spring.aim = error * spring.length;
    spring.slope = max(dot(spring.d, spring.g), max(square, tiny));
  }
  return spring;
}

/// How far projecting a spring moves x_a, per inverse mass; x_b moves the other way. Adds to the
/// multipliers.
///
/// w           how far d moves per pull: the sum of both inverse masses
/// relaxation  times what a projection alone would correct
template <class Lanes, SpringLaw law, bool first>
Vec3Lanes<Lanes> pull_of(const Vec3Lanes<Lanes>& d_begin, const Vec3Lanes<Lanes>& change_of_d,
                         Lanes w, const SpringBlock& block, int lane, float* multiplier,
                         Lanes relaxation = Lanes::all(1)) {
  const auto spring = linearise<Lanes, law, first>(d_begin, change_of_d, block, lane, multiplier);
  const Lanes f =
      relaxation *
      (spring.aim / (spring.slope * (w + Lanes::load(block.denominator_share.data() + lane))));
  if constexpr (law != SpringLaw::rigid)
    add_to_multiplier<first>(f * spring.slope / spring.length, multiplier);
  return f * spring.g;
}

/// (C + compliance/h^2 lambda)^2 [m^2], 0 in empty lanes.
template <class Lanes, SpringLaw law>
Lanes squared_error(const Vec3Lanes<Lanes>& d_begin, const Vec3Lanes<Lanes>& change_of_d,
                    const SpringBlock& block, int lane, const float* multiplier) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  const auto spring = linearise<Lanes, law, false>(d_begin, change_of_d, block, lane, multiplier);
  Lanes error;  // (l^2 - L^2)/2 = (l - L) (l + L)/2
  if constexpr (law == SpringLaw::rigid) {
    const Lanes rest = Lanes::load(block.rest.data() + lane);
    error = Lanes::all(2.0f) * spring.aim / (sqrt(dot(spring.d, spring.d)) + sqrt(rest));
  } else {
    error = spring.aim / spring.length;
  }
  const Lanes occupied = Lanes::all(kLargest) - Lanes::load(block.denominator_share.data() + lane);
  return where_positive(occupied, error * error);
}

}  // namespace pleat
