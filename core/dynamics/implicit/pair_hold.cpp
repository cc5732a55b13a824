#include "core/dynamics/implicit/pair_hold.h"

#include <algorithm>

namespace pleat {
namespace {

/// Share of what its vertices resist with alone, with which a pair is held: the whole of it makes
/// one that is held in vain press its neighbours apart.
constexpr double kShare = 0.01;
/// Share of the weight that a pair moves which may pull it together for one substep.
constexpr double kLeastPairPull = 0.1;
/// Weights beyond friction by which a pair that sticks is torn loose.
constexpr double kLeastPairExcess = 0.1;
/// Pairs join in the matrix that are nearer than this many times the gap that they rest at.
constexpr double kJoinReach = 4;

Vec3 part_along(const Vec3& normal, const Vec3& vector) { return normal.dot(vector) * normal; }

/// The last force, no larger than the one before it: an impact ends with its substep.
Vec3 lasting_force(const WatchedPair& pair) {
  const double last = pair.force.norm();
  return last > pair.force_before ? Vec3(pair.force_before / last * pair.force) : pair.force;
}

Vec3 force_of(const PairHold::Held& held, const Positions& velocities, double h) {
  return held.force + held.resistance * (held.velocity - held.sum_of(velocities)) / h;
}

}  // namespace

Vec3 PairHold::Held::sum_of(const Positions& columns) const {
  Vec3 sum(0, 0, 0);
  for (const Term& term : parts()) sum += term.factor * columns.col(term.vertex);
  return sum;
}

// Vertices that hang are moved by their parents; prescribed ones move for none.
void PairHold::take_in(const PairContact& contact, double h) {
  const WatchedPair& pair = contact_.pairs()[static_cast<std::size_t>(contact.pair)];
  Held held;
  held.pair = contact.pair;
  held.normal = contact.normal;
  held.force = lasting_force(pair);
  const Vec3 onward = (contact.wanted - contact.gap) / h * contact.normal;
  held.velocity = onward;
  held.sticks = pair.sticks;
  if (held.sticks) held.velocity -= (pair.slip - part_along(contact.normal, pair.slip)) / h;
  const auto add = [&](VertexId v, double factor) {
    if (contact_.is_pinned(v)) {
      held.velocity -= factor / h * (ends_.col(v) - begins_.col(v));
      return;
    }
    for (std::size_t k = 0; k < held.n_terms; ++k)
      if (held.terms[k].vertex == v) {
        held.terms[k].factor += factor;
        return;
      }
    held.terms[held.n_terms++] = {v, factor};
  };
  for (std::size_t k = 0; k < 4; ++k) {
    if (contact.weights[k] == 0) continue;
    for (const VertexId carrier : contact_.movers().carriers(pair.sides.vertices[k]))
      add(carrier, contact.weights[k] / 2);
  }
  double softness = 0;
  for (const Term& term : held.parts())
    softness += term.factor * term.factor / model_.masses[term.vertex];
  if (softness == 0) return;
  held.mass = 1 / softness;
  held_.push_back(held);
}

/// True where the closest points of a pair that has not pressed yet would end too near.
bool PairHold::closes(const PairContact& contact, const WatchedPair& pair) const {
  double gap = 0;
  for (std::size_t k = 0; k < 4; ++k)
    gap += contact.weights[k] * contact.normal.dot(ends_.col(pair.sides.vertices[k]));
  return gap < pair.gap;
}

void PairHold::choose(const State& state, double time_end, double h) {
  begins_ = contact_.all_begins();
  ends_ = contact_.all_ends();
  choose_from(state, time_end, h);
}

void PairHold::choose_at_rest(const State& state, double time, double h) {
  begins_ = ends_ = contact_.all_ends();
  choose_from({state.positions, h * model_.gravity.replicate(1, model_.n_vertices())}, time, h);
}

void PairHold::choose_from(const State& state, double time_end, double h) {
  held_.clear();
  begins_.leftCols(model_.n_vertices()) = state.positions;
  ends_.leftCols(model_.n_vertices()) = state.positions + h * state.velocities;
  for (const Pin& pin : model_.pins) ends_.col(pin.vertex) = pin.position(time_end);
  const std::span<const WatchedPair> pairs = contact_.pairs();
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const WatchedPair& pair = pairs[p];
    if (pair.force.isZero(0) && least_gap(pair.sides, pair.normal, ends_) >= pair.gap) continue;
    const auto contact = pair_contact(pair, static_cast<int>(p), begins_);
    if (contact && (!pair.force.isZero(0) || closes(*contact, pair))) take_in(*contact, h);
  }
}

bool PairHold::fits(const SystemMatrix& matrix) const {
  for (const Held& held : held_)
    for (std::size_t i = 0; i < held.n_terms; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!matrix.joins(held.terms[i].vertex, held.terms[j].vertex)) return false;
  return true;
}

std::vector<std::array<VertexId, 2>> PairHold::joins() const {
  std::vector<std::array<VertexId, 2>> joins;
  std::vector<VertexId> carriers;
  for (const WatchedPair& pair : contact_.pairs()) {
    const bool presses = !pair.force.isZero(0);
    if (!presses && least_gap(pair.sides, pair.normal, begins_) > kJoinReach * pair.gap) continue;
    carriers.clear();
    for (const VertexId v : pair.sides.vertices)
      for (const VertexId carrier : contact_.movers().carriers(v))
        if (!contact_.is_pinned(carrier)) carriers.push_back(carrier);
    std::sort(carriers.begin(), carriers.end());
    carriers.erase(std::unique(carriers.begin(), carriers.end()), carriers.end());
    for (std::size_t i = 0; i < carriers.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) joins.push_back({carriers[i], carriers[j]});
  }
  for (const Held& held : held_)
    for (std::size_t i = 0; i < held.n_terms; ++i)
      for (std::size_t j = 0; j < i; ++j)
        joins.push_back({held.terms[i].vertex, held.terms[j].vertex});
  return joins;
}

void PairHold::set_resistances(const SystemMatrix& matrix, double mass_unit) {
  resistances_.resize(model_.n_vertices());
  for (Eigen::Index i = 0; i < resistances_.size(); ++i)
    resistances_[i] = mass_unit / 3 * matrix.diagonal_trace(VertexId(i));
  set_resistances(resistances_);
}

// Softnesses of vertices add up: the softer side yields.
void PairHold::set_resistances(const Eigen::VectorXd& resistances) {
  for (Held& held : held_) {
    double softness = 0;
    for (const Term& term : held.parts())
      softness += term.factor * term.factor / resistances[term.vertex];
    held.stiffness = kShare / softness;
    const Mat3 normal = held.normal * held.normal.transpose();
    held.resistance = held.stiffness * (held.sticks ? Mat3(Mat3::Identity()) : normal);
  }
}

void PairHold::add_remembered(Positions& forces) const {
  for (const Held& held : held_)
    for (const Term& term : held.parts()) forces.col(term.vertex) += term.factor * held.force;
}

/// Frees a pair that would pull; true where it did.
bool PairHold::free_pulling(Held& held, const Vec3& force) const {
  const double weight = model_.gravity.norm() * held.mass;
  if (!held.may_be_freed || held.normal.dot(force) >= -kLeastPairPull * weight) return false;
  held.may_be_freed = held.sticks = false;
  held.resistance.setZero();
  held.force.setZero();
  return true;
}

/// Lets a pair slip that would be rubbed beyond friction; true where it did.
bool PairHold::let_slip(Held& held, const Vec3& force) const {
  const double weight = model_.gravity.norm() * held.mass;
  const double pressing = std::max(held.normal.dot(force), 0.0);
  const Vec3 rubbing = force - part_along(held.normal, force);
  const double friction = contact_.friction(contact_.pairs()[static_cast<std::size_t>(held.pair)]);
  if (!held.sticks || rubbing.norm() <= friction * pressing + kLeastPairExcess * weight)
    return false;
  held.sticks = false;
  held.resistance = held.stiffness * held.normal * held.normal.transpose();
  held.force = part_along(held.normal, held.force) + friction * pressing * rubbing.normalized();
  return true;
}

// Pairs that pull go first: others may stick once nothing pulls.
std::span<const PairHold::Held> PairHold::let_loose(const Positions& velocities, double h) {
  lost_.clear();
  const auto look = [&](const auto& changes) {
    for (Held& held : held_) {
      Held lost = held;
      if (!changes(held, force_of(held, velocities, h))) continue;
      lost.resistance -= held.resistance;
      lost.force -= held.force;
      lost_.push_back(lost);
    }
  };
  look([this](Held& held, const Vec3& force) { return free_pulling(held, force); });
  if (lost_.empty()) look([this](Held& held, const Vec3& force) { return let_slip(held, force); });
  return lost_;
}

void PairHold::add(std::span<const Held> held, const Positions& velocities, double h, Units units,
                   SystemMatrix& matrix, PositionsRef rhs) {
  for (const Held& pair : held) {
    const Vec3 impulse =
        pair.resistance * (pair.velocity - pair.sum_of(velocities)) + h * pair.force;
    for (std::size_t i = 0; i < pair.n_terms; ++i) {
      const auto& [vertex, factor] = pair.terms[i];
      rhs.col(vertex) += units.rhs * factor * impulse;
      matrix.add_diagonal(vertex, units.matrix * factor * factor * pair.resistance);
      for (std::size_t j = 0; j < i; ++j)
        matrix.add_between(vertex, pair.terms[j].vertex,
                           units.matrix * factor * pair.terms[j].factor * pair.resistance);
    }
  }
}

void PairHold::remember(const Positions& velocities, double h, ClothContact& contact) const {
  for (const Held& held : held_) {
    WatchedPair& pair = contact.pairs()[static_cast<std::size_t>(held.pair)];
    pair.force_before = pair.force.norm();
    pair.force = force_of(held, velocities, h);
    pair.is_solved = true;
  }
}

}  // namespace pleat
