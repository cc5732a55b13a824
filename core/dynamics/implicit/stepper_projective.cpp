#include "core/dynamics/implicit/stepper_projective.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "core/base/simd.h"
#include "core/model/elasticity.h"
#include "core/model/hanging_vertices.h"

namespace pleat {
namespace {

constexpr int kNotPinned = -1;

/// Share of its own resistance with which a vertex is held: the more, the fewer substeps until
/// the remembered force is what it should be, and the more rounds until one that may slip has.
constexpr double kHeldShare = 0.1;

/// Rounding errors of a sum of pulls, in shares of the largest.
constexpr double kLoadRounding = 100 * std::numeric_limits<double>::epsilon();

bool damps_along_spring(const ClothModel& model) {
  return model.damping_direction == DampingDirection::along_spring;
}

}  // namespace

StepperProjective::StepperProjective(ClothModel& model, const MethodOptions& options)
    : Stepper(model, options, options.substeps, ContactForces::remembered),
      solver_(make_solver(options)),
      targets_(model.springs.size()),
      forces_(3, model.n_vertices()),
      predicted_(Positions::Zero(3, model.n_vertices())),
      positions_(3, model.n_vertices()),
      first_change_(3, model.n_vertices()),
      right_side_(model.n_vertices(), 3),
      solution_(model.n_vertices(), 3) {
  if (options.acceleration == Acceleration::anderson) {
    acceleration_.emplace(model.n_vertices());
    start_.resize(model.n_vertices(), 6);
    steady_side_.resize(model.n_vertices(), 3);
    proposed_.resize(3, model.n_vertices());
  }
  if (model_.contact) {
    hold_.emplace(model_, kHeldShare, Pressing::of_own_mass);
    velocities_.resize(3, model.n_vertices());
  }
  if (model.air) {
    air_forces_.resize(3, model.n_vertices());
    other_forces_ = model.gravity * model.masses.transpose();
  }
  refresh();
}

/// M/h^2 + sum over springs and bending elements, one number per pair of vertices because x, y and
/// z do not couple. The damper's c/h joins k whichever way it acts. LoadedRows of vertices that are
/// pinned or hang are those of the identity.
void StepperProjective::refresh() {
  const int n = model_.n_vertices();
  const double h = options().step / substeps();
  std::vector<int> pin_of(static_cast<std::size_t>(n), kNotPinned);
  for (std::size_t p = 0; p < model_.pins.size(); ++p)
    pin_of[model_.pins[p].vertex] = static_cast<int>(p);

  is_free_.resize(static_cast<std::size_t>(n));
  std::vector<Eigen::Triplet<double>> entries;
  pinned_entries_.clear();
  const auto add = [&](VertexId a, VertexId b, double value) {
    if (pin_of[a] == kNotPinned && pin_of[b] == kNotPinned) {
      entries.emplace_back(std::max(a.value, b.value), std::min(a.value, b.value), value);
    } else if (pin_of[a] == kNotPinned) {
      pinned_entries_.push_back({a, pin_of[b], value});
    } else if (pin_of[b] == kNotPinned) {
      pinned_entries_.push_back({b, pin_of[a], value});
    }
  };
  const FreeCombinations in_free_vertices(n, model_.hanging);
  const auto add_square = [&](const Combination& sum, double weight) {
    for (std::size_t i = 0; i < sum.n_terms; ++i)
      for (std::size_t j = i; j < sum.n_terms; ++j)
        add(sum.terms[i].vertex, sum.terms[j].vertex,
            weight * sum.terms[i].factor * sum.terms[j].factor);
  };
  for (int i = 0; i < n; ++i) {
    is_free_[i] = pin_of[i] == kNotPinned && !model_.hangs(VertexId(i));
    entries.emplace_back(i, i, is_free_[i] ? model_.masses[i] / (h * h) : 1);
  }
  constexpr std::array<double, 2> kDifference = {1, -1};
  for (const Spring& spring : model_.springs)
    add_square(in_free_vertices(std::array{spring.a, spring.b}, kDifference),
               spring.stiffness + spring.damping / h);
  for (const BendElement& bend : model_.bends)
    add_square(in_free_vertices(bend.vertices, bend.weights), bend.stiffness);
  matrix_.resize(n, n);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  diagonal_ = matrix_.diagonal();
  solver_->analyze(matrix_);
  factor_report_ = solver_->factorize(matrix_);
  if (!hold_) return;
  hold_->set_resistances(h * h * diagonal_);
  is_held_.assign(static_cast<std::size_t>(n), char{0});
}

void StepperProjective::hold(const State& state, double h) {
  const PartScope scope(observer_, Part::contact);
  was_held_ = is_held_;
  std::fill(is_held_.begin(), is_held_.end(), char{0});
  hold_->choose(contact_memory_, state, h);
  for (const ContactHold::Held& held : hold_->held()) is_held_[held.vertex] = is_free_[held.vertex];
  if (is_held_ == was_held_) return;
  for (int i = 0; i < model_.n_vertices(); ++i)
    matrix_.valuePtr()[matrix_.outerIndexPtr()[i]] =
        (is_held_[i] ? 1 + kHeldShare : 1) * diagonal_[i];
  const PartScope factor_scope(observer_, Part::factor);
  factor_report_ = solver_->factorize(matrix_);
}

void StepperProjective::set_targets(double h) {
  const bool along = damps_along_spring(model_);
  const double per_second = 1 / h;
  for (std::size_t s = 0; s < model_.springs.size(); ++s) {
    const Spring& spring = model_.springs[s];
    Target& target = targets_[s];
    target = {spring.stiffness, spring.rest_length, Vec3::Zero()};
    if (spring.damping == 0) continue;
    const double damper = per_second * spring.damping;
    const Vec3 d = positions_begin_.col(spring.a) - positions_begin_.col(spring.b);
    if (along) {
      target.weight += damper;
      target.length = (spring.stiffness * spring.rest_length + damper * d.norm()) / target.weight;
    } else {
      target.damped = damper * d;
    }
  }
}

template <class PullOfSpring>
void StepperProjective::add_up(double time_end, double h, const PullOfSpring& pull_of,
                               VertexRows& side) const {
  for (int i = 0; i < model_.n_vertices(); ++i)
    side.row(i) = (model_.masses[i] / (h * h) * predicted_.col(i)).transpose();
  for (std::size_t s = 0; s < model_.springs.size(); ++s) {
    const Vec3 pull = pull_of(model_.springs[s], targets_[s]);
    side.row(model_.springs[s].a) += pull.transpose();
    side.row(model_.springs[s].b) -= pull.transpose();
  }
  pull_to_parents(model_.hanging, side.transpose());
  if (hold_)
    for (const ContactHold::Held& held : hold_->held())
      side.row(held.vertex) +=
          (held.resistance / (h * h) * (positions_begin_.col(held.vertex) + h * held.velocity))
              .transpose();
  for (const PinnedEntry& entry : pinned_entries_)
    side.row(entry.free_vertex) -=
        entry.value * model_.pins[entry.pin].position(time_end).transpose();
  for (const Pin& pin : model_.pins) side.row(pin.vertex) = pin.position(time_end).transpose();
}

void StepperProjective::set_right_side(double time_end, double h) {
  const auto projected = [this](const Spring& spring, const Target& target) -> Vec3 {
    const Vec3 d = positions_.col(spring.a) - positions_.col(spring.b);
    const double length = d.norm();
    const double scale = length > 0 ? target.weight * target.length / length : 0;
    return scale * d + target.damped;
  };
  add_up(time_end, h, projected, right_side_);
  if (!hold_) return;
  for (int i = 0; i < model_.n_vertices(); ++i)
    if (is_held_[i] != 0)
      right_side_.row(i) += hold_excess(VertexId(i)) * positions_.col(i).transpose();
  for (const ContactHold::Held& held : hold_->held())
    if (is_held_[held.vertex] != 0)
      right_side_.row(held.vertex) -=
          (held.resistance / (h * h) * positions_.col(held.vertex)).transpose();
}

/// Excess of the matrix on the diagonal for the hold of a vertex, whichever way it is held [N/m].
double StepperProjective::hold_excess(VertexId vertex) const {
  return kHeldShare * diagonal_[vertex];
}

// A vertex that leaves its solid moves little in the rounds that are left, as the matrix goes on
// holding it. So it goes on from where its forces take it alone, if that is off the solid. One that
// only slips is pressed as before: its force alone would throw it far off its neighbours.
bool StepperProjective::free_pulled(double h) {
  if (!hold_) return false;
  velocities_ = (positions_ - positions_begin_) / h;
  const auto lost = hold_->let_loose(contact_memory_, velocities_, h);
  for (const ContactHold::Held& held : lost) {
    const VertexId v = held.vertex;
    predicted_.col(v) -= h * h / model_.masses[v] * held.force;
    if (!held.leaves) continue;
    const double rise = held.normal.dot(predicted_.col(v) - positions_.col(v));
    positions_.col(v) += std::max(rise, 0.0) * held.normal;
  }
  return !lost.empty();
}

/// Norm of what rounding makes of the matrix times positions_ [N].
double StepperProjective::rounding_of_loads() const {
  double sum = 0;
  for (int i = 0; i < model_.n_vertices(); ++i)
    sum += diagonal_[i] * diagonal_[i] * positions_.col(i).squaredNorm();
  return kLoadRounding * std::sqrt(sum);
}

void StepperProjective::start_acceleration(double time_end, double h) {
  const auto damped = [](const Spring&, const Target& target) { return target.damped; };
  add_up(time_end, h, damped, steady_side_);
  places(start_) = positions_.transpose();
  for (const HangingVertex& vertex : model_.hanging) start_.row(vertex.vertex).setZero();
  const auto A = matrix_.selfadjointView<Eigen::Lower>();
  for (int c = 0; c < 3; ++c) loads(start_).col(c).noalias() = A * places(start_).col(c);
  acceleration_->start(start_, rounding_of_loads());
}

// The rounds lower x.Ax/2 - x.b_0 - sum k L l(x): b(x) = b_0 + sum S^T p is where the last term
// pulls. At the image x of a round, A x = b, so that from x to x + d this changes by
// d.(b - b_0) + d.Ad/2 - sum k L (l(x + d) - l(x)), in which nothing large cancels.
double StepperProjective::energy_change(const LoadedRows& change, double h) const {
  double sum = places(change).cwiseProduct(right_side_ - steady_side_ + loads(change) / 2).sum();
  for (std::size_t s = 0; s < model_.springs.size(); ++s) {
    const Spring& spring = model_.springs[s];
    const Vec3 begin = positions_.col(spring.a) - positions_.col(spring.b);
    const Vec3 end = proposed_.col(spring.a) - proposed_.col(spring.b);
    const double lengths = begin.norm() + end.norm();
    if (lengths > 0)
      sum -= targets_[s].weight * targets_[s].length * (end - begin).dot(end + begin) / lengths;
  }
  if (!hold_) return sum;
  for (int i = 0; i < model_.n_vertices(); ++i)
    if (is_held_[i] != 0)
      sum -= hold_excess(VertexId(i)) / 2 *
             (proposed_.col(i) - positions_.col(i)).dot(proposed_.col(i) + positions_.col(i));
  for (const ContactHold::Held& held : hold_->held()) {
    const Vec3 begin = positions_.col(held.vertex);
    const Vec3 end = proposed_.col(held.vertex);
    if (is_held_[held.vertex] != 0)
      sum += (end - begin).dot(held.resistance * (end + begin)) / (2 * h * h);
  }
  return sum;
}

void StepperProjective::accelerate(double h) {
  const auto* change = acceleration_->propose(solution_, right_side_);
  if (change == nullptr) return;
  proposed_ = (solution_ + places(*change)).transpose();
  place_between_parents(model_.hanging, proposed_);
  if (energy_change(*change, h) < 0) {
    positions_.swap(proposed_);
    acceleration_->accept();
  } else {
    acceleration_->refuse();
  }
}

// Starts without the remembered forces: alone they would throw a light vertex far away from its
// neighbours. A held vertex begins where it comes to alone: along the normal where it is held, and
// across it where the hold, which is its friction, lets a mass come.
void StepperProjective::place_first_guess(double time_end, double h) {
  positions_ = predicted_;
  if (contact_memory_.has_forces())
    for (int i = 0; i < model_.n_vertices(); ++i)
      if (!model_.hangs(VertexId(i)))
        positions_.col(i) -= h * h / model_.masses[i] * contact_memory_.forces().col(i);
  for (const Pin& pin : model_.pins) positions_.col(pin.vertex) = pin.position(time_end);
  place_between_parents(model_.hanging, positions_);
  first_change_ = positions_;
  if (!hold_) return;
  for (const ContactHold::Held& held : hold_->held()) {
    const VertexId v = held.vertex;
    if (!is_held_[v]) continue;
    const Vec3 way = positions_begin_.col(v) + h * held.velocity - positions_.col(v);
    const Vec3 along = held.normal.dot(way) * held.normal;
    const Mat3 with_mass = model_.masses[v] * Mat3::Identity() + held.resistance;
    positions_.col(v) += along + with_mass.inverse() * (held.resistance * (way - along));
  }
  place_between_parents(model_.hanging, positions_);
}

/// Slopes of the energy that the rounds lower [J], along fall_: at positions_, and where it ends.
/// Springs are asked for both at once, a lane each.
std::array<double, 2> StepperProjective::slopes(double h) const {
  using Both = Simd<double, 2>;
  Both slope = Both::all(0);
  for (int i = 0; i < model_.n_vertices(); ++i) {
    if (model_.hangs(VertexId(i))) continue;
    const Vec3 fall = fall_.col(i);
    const double inertia = model_.masses[i] / (h * h);
    const double begin = inertia * fall.dot(positions_.col(i) - predicted_.col(i));
    slope = slope + Both{{begin, begin + inertia * fall.squaredNorm()}};
  }
  for (std::size_t s = 0; s < model_.springs.size(); ++s) {
    const Spring& spring = model_.springs[s];
    const Target& target = targets_[s];
    const Vec3 d = positions_.col(spring.a) - positions_.col(spring.b);
    const Vec3 fall = fall_.col(spring.a) - fall_.col(spring.b);
    const auto along = [&](int k) { return Both{{d[k], d[k] + fall[k]}}; };
    const Vec3Lanes<Both> way = {along(0), along(1), along(2)};
    const Both length = sqrt(dot(way, way));
    const Both slack = where_positive(length, Both::all(target.length) / length);
    const Both tension = Both::all(target.weight) * (Both::all(1) - slack);
    const Vec3Lanes<Both> falls = {Both::all(fall.x()), Both::all(fall.y()), Both::all(fall.z())};
    slope = slope + tension * dot(way, falls) - Both::all(target.damped.dot(fall));
  }
  for (const BendElement& bend : model_.bends) {
    Vec3 curve(0, 0, 0);
    Vec3 fall(0, 0, 0);
    for (std::size_t k = 0; k < bend.vertices.size(); ++k) {
      curve += bend.weights[k] * positions_.col(bend.vertices[k]);
      fall += bend.weights[k] * fall_.col(bend.vertices[k]);
    }
    const double begin = bend.stiffness * curve.dot(fall);
    slope = slope + Both{{begin, begin + bend.stiffness * fall.squaredNorm()}};
  }
  return {slope.value[0], slope.value[1]};
}

// Where every force but the springs' takes vertices, springs at pins have turned, and few rounds do
// not turn them back: what they come to is at rest below the equilibrium. Where the cloth coasts,
// equilibrium stays as it is, but few rounds hold back what falls. So it starts between the two,
// where the energy is least if its slope is linear there: at rest it coasts, in free fall it falls.
void StepperProjective::ease_first_guess(double h) {
  if (model_.pins.empty() && !(hold_ && !hold_->held().empty())) return;
  fall_ = positions_;
  for (int i = 0; i < model_.n_vertices(); ++i)
    if (is_free_[i] != 0 && !(hold_ && is_held_[i] != 0))
      positions_.col(i) = positions_begin_.col(i) + h * velocities_begin_.col(i);
  place_between_parents(model_.hanging, positions_);
  fall_ -= positions_;
  const auto [coasting, fallen] = slopes(h);
  double share = fallen <= 0 ? 1 : coasting / (coasting - fallen);
  if (coasting >= 0) share = 0;
  positions_ += share * fall_;
}

void StepperProjective::add_air_forces(const State& begin, double h) {
  model_.air->set_damped_forces(begin.positions, begin.velocities, model_.masses, model_.hanging, h,
                                other_forces_, air_forces_);
  forces_ += air_forces_;
}

void StepperProjective::remember_motion(const State& end, double h) {
  if (!model_.air) return;
  other_forces_ = (end.velocities - velocities_begin_) * model_.masses.asDiagonal() / h;
  other_forces_ -= air_forces_;
}

SolveReport StepperProjective::substep(State& state, double time_end, double h) {
  if (!factor_report_.ok()) return factor_report_;
  positions_begin_ = state.positions;
  velocities_begin_ = state.velocities;
  if (hold_) hold(state, h);
  if (!factor_report_.ok()) return factor_report_;
  {
    const PartScope scope(observer_, Part::forces);
    forces_.setZero();
    add_gravity(model_, forces_);
    if (contact_memory_.has_forces()) forces_ += contact_memory_.forces();
    if (model_.air) add_air_forces(state, h);
    for (int i = 0; i < model_.n_vertices(); ++i) {
      if (model_.hangs(VertexId(i))) continue;
      predicted_.col(i) = state.positions.col(i) + h * state.velocities.col(i) +
                          h * h / model_.masses[i] * forces_.col(i);
    }
    place_first_guess(time_end, h);
    set_targets(h);
    ease_first_guess(h);
    if (acceleration_) start_acceleration(time_end, h);
  }
  SolveReport report;
  for (int round = 0; round < options().iterations; ++round) {
    {
      const PartScope scope(observer_, Part::assembly);
      if (round > 0 && free_pulled(h) && acceleration_) start_acceleration(time_end, h);
      set_right_side(time_end, h);
    }
    const PartScope scope(observer_, Part::solve);
    report = solver_->solve(right_side_, solution_);
    if (!report.ok()) return report;
    if (round == 0) first_change_ = solution_.transpose() - first_change_;
    positions_ = solution_.transpose();
    place_between_parents(model_.hanging, positions_);
    if (acceleration_) accelerate(h);
  }
  report.iterations = options().iterations;
  time_end_ = time_end;
  state.positions = positions_;
  state.velocities = (positions_ - positions_begin_) / h;
  if (hold_) hold_->add_forces(state.velocities, h, contact_memory_.forces());
  correct(state, time_end, h, hold_ ? hold_->resistances() : model_.masses);
  remember_motion(state, h);
  return report;
}

/// |b(x) - A x| over its value where neither springs nor solids act, for the last substep. Cloth
/// that only falls is predicted to rounding: what rounding makes of A x is nothing to be solved.
void StepperProjective::store(State&, SolveReport& report) {
  if (!report.ok()) return;
  set_right_side(time_end_, options().step / substeps());
  const auto A = matrix_.selfadjointView<Eigen::Lower>();
  solution_ = first_change_.transpose();
  double first = 0;
  double last = 0;
  const auto clear_hanging = [this] {
    for (const HangingVertex& vertex : model_.hanging) column_[vertex.vertex] = 0;
  };
  for (int c = 0; c < 3; ++c) {
    column_.noalias() = A * solution_.col(c);
    clear_hanging();
    first += column_.squaredNorm();
    solution_.col(c) = positions_.row(c).transpose();
    column_ = right_side_.col(c);
    column_.noalias() -= A * solution_.col(c);
    clear_hanging();
    last += column_.squaredNorm();
  }
  const double unsolved = std::max(std::sqrt(first), rounding_of_loads());
  report.relative_residual = first > 0 ? std::sqrt(last) / unsolved : 0;
}

}  // namespace pleat
