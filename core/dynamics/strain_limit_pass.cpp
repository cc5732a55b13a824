#include "core/dynamics/strain_limit_pass.h"

#include <algorithm>
#include <array>

#include "core/base/check.h"

namespace pleat {
namespace {

/// Sweeps aim inside the limit by this share of what it allows, so that a finite number of them
/// ends below it.
constexpr double kMargin = 0.01;
/// How often a line is solved again with other edges active.
constexpr int kMaxSolves = 50;

}  // namespace

Vec3 StrainLimitPass::SharedEnds::difference(const PositionsView& positions) const {
  Vec3 d(0, 0, 0);
  for (std::size_t i = 0; i < sum.n_terms; ++i)
    d += sum.terms[i].factor * positions.col(sum.terms[i].vertex);
  return d;
}

StrainLimitPass::StrainLimitPass(const ClothModel& model)
    : model_(model),
      options_(model.strain_limit->options),
      limits_{1 - options_.compression, 1 + options_.stretch},
      goals_{1 - (1 - kMargin) * options_.compression, 1 + (1 - kMargin) * options_.stretch},
      inverse_masses_(model.n_vertices()),
      proposed_(3, model.n_vertices()) {
  const FreeCombinations in_free_vertices(model.n_vertices(), model.hanging);
  constexpr std::array<double, 2> kDifference = {1, -1};
  VertexId line_end;
  std::size_t longest_line = 0;
  for (const GaugeEdge& edge : model.strain_limit->edges) {
    if (model.hangs(edge.a) || model.hangs(edge.b)) {
      shared_edges_.push_back(
          {{in_free_vertices(std::array{edge.a, edge.b}, kDifference)}, edge.rest_length});
      line_end = VertexId();
      continue;
    }
    if (!line_end.valid() || line_end != edge.a) lines_.push_back({edges_.size(), edges_.size()});
    edges_.push_back({{edge.a, edge.b}, edge.rest_length});
    lines_.back().end = edges_.size();
    longest_line = std::max(longest_line, lines_.back().end - lines_.back().begin);
    line_end = edge.b;
  }
  demands_.resize(longest_line);
  line_ends_.resize(longest_line + 1);
  if (model.contact) normals_ = Positions::Zero(3, model.n_vertices());
}

void StrainLimitPass::set_inverse_masses() {
  for (Eigen::Index i = 0; i < inverse_masses_.size(); ++i)
    inverse_masses_[i] = model_.masses[i] > 0 ? 1 / model_.masses[i] : 0;
  for (const Pin& pin : model_.pins) inverse_masses_[pin.vertex] = 0;
}

template <class EndsKind>
bool StrainLimitPass::exceeds(const Edge<EndsKind>& edge, double squared_length) const {
  const double longest = limits_.longest * edge.rest_length;
  const double shortest = limits_.shortest * edge.rest_length;
  return squared_length > longest * longest || squared_length < shortest * shortest;
}

template <class EndsKind>
bool StrainLimitPass::is_beyond(const Edge<EndsKind>& edge, const PositionsView& positions) const {
  return exceeds(edge, edge.ends.difference(positions).squaredNorm()) &&
         inverse_mass(edge.ends) > 0;
}

template <class EndsKind>
double StrainLimitPass::inverse_mass(const EndsKind& ends) const {
  double sum = 0;
  ends.for_each([&](VertexId v, double factor) { sum += factor * factor * inverse_masses_[v]; });
  return sum;
}

template <class EndsKind>
void StrainLimitPass::pull(const EndsKind& ends, const Vec3& impulse, Positions& positions) const {
  ends.for_each([&](VertexId v, double factor) {
    Vec3 move = -factor * inverse_masses_[v] * impulse;
    if (is_touched_) {
      const auto normal = normals_.col(v);
      move -= std::min(0.0, move.dot(normal)) * normal;
    }
    positions.col(v) += move;
  });
}

template <class EndsKind>
StrainLimitPass::Demand StrainLimitPass::demand_of(const Edge<EndsKind>& edge,
                                                   const Positions& positions) const {
  Demand demand;
  const Vec3 end = edge.ends.difference(positions);
  demand.length = end.norm();
  demand.inverse_mass = inverse_mass(edge.ends);
  if (demand.length == 0 || demand.inverse_mass == 0) return demand;
  demand.direction = end / demand.length;
  const bool is_guessed = is_first_sweep_ && edge.was_active;
  demand.is_active =
      edge.impulse != 0 || is_guessed || exceeds(edge, demand.length * demand.length);
  demand.pulls = edge.impulse != 0 ? edge.impulse > 0 : demand.length > edge.rest_length;
  demand.shortening =
      demand.length - (demand.pulls ? goals_.longest : goals_.shortest) * edge.rest_length;
  return demand;
}

template <class EndsKind>
double StrainLimitPass::impulse_after(const Edge<EndsKind>& edge, const Demand& demand) {
  const double after = edge.impulse + demand.impulse;
  return (demand.pulls ? after >= 0 : after <= 0) ? after : 0;
}

template <class EndsKind>
void StrainLimitPass::apply(Edge<EndsKind>& edge, const Demand& demand,
                            Positions& positions) const {
  const double after = impulse_after(edge, demand);
  const double impulse = after - edge.impulse;
  if (options_.law == StrainLimitLaw::velocity) edge.impulse = after;
  pull(edge.ends, impulse * demand.direction, positions);
}

/// These return true when an edge exceeded before it was corrected.
template <class EndsKind>
bool StrainLimitPass::correct(Edge<EndsKind>& edge, Positions& positions) {
  Demand demand = demand_of(edge, positions);
  if (!demand.is_active) return false;
  demand.impulse = demand.shortening / demand.inverse_mass;
  apply(edge, demand, positions);
  return exceeds(edge, demand.length * demand.length);
}

void StrainLimitPass::demand(const Line& line, const Positions& positions) {
  const std::size_t n_edges = line.end - line.begin;
  for (std::size_t k = 0; k < n_edges; ++k) {
    const Edge<Ends>& edge = edges_[line.begin + k];
    demands_[k] = demand_of(edge, positions);
    if (k > 0)
      demands_[k - 1].coupling =
          -inverse_masses_[edge.ends.a] * demands_[k - 1].direction.dot(demands_[k].direction);
  }
}

/// Gives up the edges between pins that are farther apart than the limit allows: impulses would
/// only add up.
void StrainLimitPass::leave_overstretched(const Line& line, const Positions& positions) {
  std::size_t first = line.begin;  // edge after the last pinned vertex
  VertexId pinned;
  double length = 0;  // length of the line since then, at its limits
  if (inverse_masses_[edges_[first].ends.a] == 0) pinned = edges_[first].ends.a;
  for (std::size_t e = line.begin; e < line.end; ++e) {
    length += limits_.longest * edges_[e].rest_length;
    const VertexId end = edges_[e].ends.b;
    if (inverse_masses_[end] != 0) continue;
    if (pinned.valid() && (positions.col(end) - positions.col(pinned)).norm() > length)
      for (std::size_t k = first; k <= e; ++k) {
        demands_[k - line.begin].is_active = false;
        demands_[k - line.begin].is_spent = true;
      }
    first = e + 1;
    pinned = end;
    length = 0;
  }
}

/// The factor on the diagonal of a line's system. A line between two pins has a system that is
/// singular or nearly so: its diagonal grows by about its smallest other eigenvalue.
double StrainLimitPass::diagonal_factor(const Line& line) const {
  int n_pinned = inverse_masses_[edges_[line.begin].ends.a] == 0 ? 1 : 0;
  for (std::size_t e = line.begin; e < line.end; ++e)
    if (inverse_masses_[edges_[e].ends.b] == 0) ++n_pinned;
  const auto length = static_cast<double>(line.end - line.begin);
  return n_pinned > 1 ? 1 + 1 / (4 * length * length) : 1;
}

// An impulse p_k shortens edge k by (w_a + w_b) p_k and lengthens its neighbour, with which it
// shares a vertex of inverse mass w, by w cos(angle) p_k: a tridiagonal system, in which inactive
// edges have no impulse and spent ones give back what they had.
void StrainLimitPass::eliminate(const Line& line, double diagonal_factor) {
  const std::size_t n_edges = line.end - line.begin;
  for (std::size_t k = 0; k < n_edges; ++k) {
    Demand& demand = demands_[k];
    if (!demand.is_active) {
      demand.after = 0;
      demand.impulse = -edges_[line.begin + k].impulse;
      continue;
    }
    double pivot = diagonal_factor * demand.inverse_mass;
    double right = demand.shortening;
    if (k > 0) {
      const Demand& before = demands_[k - 1];
      pivot -= before.coupling * before.after;
      right -= before.coupling * before.impulse;
    }
    demand.after = demand.coupling / pivot;
    demand.impulse = right / pivot;
  }
  for (std::size_t k = n_edges - 1; k-- > 0;)
    demands_[k].impulse -= demands_[k].after * demands_[k + 1].impulse;
}

/// Spends edges that would push where they pull, and activates those that the others lengthen
/// beyond their limits. Returns whether any changed.
bool StrainLimitPass::change_active(const Line& line) {
  const std::size_t n_edges = line.end - line.begin;
  bool has_changed = false;
  for (std::size_t k = 0; k < n_edges; ++k) {
    Demand& demand = demands_[k];
    const Edge<Ends>& edge = edges_[line.begin + k];
    if (demand.is_active) {
      const double sum = edge.impulse + demand.impulse;
      if (demand.pulls ? sum >= 0 : sum <= 0) continue;
      demand.is_active = false;
      demand.is_spent = true;
      has_changed = true;
    } else if (!demand.is_spent && demand.inverse_mass > 0 && demand.length > 0) {
      double length = demand.length;
      if (k > 0) length -= demands_[k - 1].coupling * demands_[k - 1].impulse;
      if (k + 1 < n_edges) length -= demand.coupling * demands_[k + 1].impulse;
      if (!demand.pulls || !exceeds(edge, length * length)) continue;
      demand.is_active = true;
      has_changed = true;
    }
  }
  return has_changed;
}

bool StrainLimitPass::pushes(const Line& line) const {
  for (std::size_t e = line.begin; e < line.end; ++e)
    if (impulse_after(edges_[e], demands_[e - line.begin]) < 0) return true;
  return false;
}

// With c = p/l, l the length at the goal and d the edges as they end, the places x obey
//   x_i + w_i sum of +-c d = what is proposed for x_i,
// a tridiagonal system. The impulses of later sweeps are little beside those of the first.
void StrainLimitPass::place_ends(const Line& line, Positions& positions) {
  const std::size_t n_edges = line.end - line.begin;
  const auto vertex = [&](std::size_t i) {
    return i < n_edges ? edges_[line.begin + i].ends.a : edges_[line.end - 1].ends.b;
  };
  for (std::size_t i = 0; i <= n_edges; ++i) line_ends_[i].place = positions.col(vertex(i));
  for (std::size_t k = 0; k < n_edges; ++k) {
    Edge<Ends>& edge = edges_[line.begin + k];
    const double length = goals_.longest * edge.rest_length;
    edge.impulse = impulse_after(edge, demands_[k]);
    line_ends_[k].pull = edge.impulse / length;
  }
  line_ends_[n_edges].pull = 0;
  for (std::size_t i = 0; i <= n_edges; ++i) {
    LineEnd& end = line_ends_[i];
    const double inverse_mass = inverse_masses_[vertex(i)];
    double pivot = 1 + inverse_mass * end.pull;
    if (i > 0) {
      const LineEnd& before = line_ends_[i - 1];
      const double coupling = inverse_mass * before.pull;
      pivot += coupling * (1 - before.next);
      end.place += coupling * before.place;
    }
    end.next = inverse_mass * end.pull / pivot;
    end.place /= pivot;
  }
  for (std::size_t i = n_edges; i-- > 0;)
    line_ends_[i].place += line_ends_[i].next * line_ends_[i + 1].place;
  for (std::size_t i = 0; i <= n_edges; ++i) positions.col(vertex(i)) = line_ends_[i].place;
}

bool StrainLimitPass::correct(const Line& line, Positions& positions) {
  const auto is_out = [&](const Edge<Ends>& edge) { return is_beyond(edge, positions); };
  const auto begin = edges_.begin() + static_cast<std::ptrdiff_t>(line.begin);
  const auto end = edges_.begin() + static_cast<std::ptrdiff_t>(line.end);
  const bool has_exceeded = std::any_of(begin, end, is_out);
  const bool is_guessed = is_first_sweep_ && std::any_of(begin, end, [](const Edge<Ends>& edge) {
                            return edge.was_active;
                          });
  if (!has_exceeded && !is_guessed) return false;
  demand(line, positions);
  leave_overstretched(line, positions);
  const double factor = diagonal_factor(line);
  for (int solve = 0; solve < kMaxSolves; ++solve) {
    eliminate(line, factor);
    if (!change_active(line)) break;
  }
  if (is_touched_ || !is_first_sweep_ || pushes(line)) {
    for (std::size_t e = line.begin; e < line.end; ++e) {
      const Demand& demand = demands_[e - line.begin];
      if (demand.impulse != 0) apply(edges_[e], demand, positions);
    }
  } else {
    place_ends(line, positions);
  }
  return has_exceeded;
}

bool StrainLimitPass::sweep(Positions& positions) {
  bool has_exceeded = false;
  if (options_.law == StrainLimitLaw::velocity)
    for (const Line& line : lines_) has_exceeded = correct(line, positions) || has_exceeded;
  else
    for (Edge<Ends>& edge : edges_) has_exceeded = correct(edge, positions) || has_exceeded;
  for (Edge<SharedEnds>& edge : shared_edges_)
    has_exceeded = correct(edge, positions) || has_exceeded;
  is_first_sweep_ = false;
  return has_exceeded;
}

void StrainLimitPass::sweep_until_within(State& state, double travel) {
  int sweeps = 0;
  bool has_exceeded = true;
  for (; has_exceeded && sweeps < options_.max_sweeps; ++sweeps)
    has_exceeded = sweep(state.positions);
  n_sweeps_ += sweeps;
  const bool is_capped = has_exceeded && is_exceeded(state.positions);
  if (is_capped) ++n_capped_;
  if (options_.law != StrainLimitLaw::velocity) return;
  const bool has_helped = !is_capped || largest_excess(state.positions) < largest_excess(proposed_);
  proposed_ = (state.positions - proposed_) / travel;  // the change of velocities
  const double share = is_capped ? share_of_least_energy(state.velocities) : 1;
  state.velocities += share * proposed_;
  if (!has_helped) state.positions -= (1 - share) * travel * proposed_;
}

// Sweeps that ran out leave impulses on their way to limits which cannot all be kept: whole, they
// may add energy. The share s of the changes dv that leaves least kinetic energy |v + s dv|^2
// counts.
double StrainLimitPass::share_of_least_energy(const Positions& velocities) const {
  double along = 0;
  double squared = 0;
  for (Eigen::Index i = 0; i < velocities.cols(); ++i) {
    along += model_.masses[i] * velocities.col(i).dot(proposed_.col(i));
    squared += model_.masses[i] * proposed_.col(i).squaredNorm();
  }
  return squared > 0 ? std::clamp(-along / squared, 0.0, 1.0) : 0;
}

void StrainLimitPass::limit(State& state, double travel) {
  set_inverse_masses();
  const auto restart = [](auto& edges) {
    for (auto& edge : edges) {
      edge.was_active = edge.impulse != 0;
      edge.impulse = 0;
    }
  };
  restart(edges_);
  restart(shared_edges_);
  proposed_ = state.positions;
  is_first_sweep_ = true;
  sweep_until_within(state, travel);
}

void StrainLimitPass::limit_again(State& state, double travel,
                                  std::span<const ContactPass::Touch> touches) {
  proposed_ = state.positions;
  for (const ContactPass::Touch& touch : touches) normals_.col(touch.vertex) = touch.normal;
  is_touched_ = true;
  sweep_until_within(state, travel);
  is_touched_ = false;
  for (const ContactPass::Touch& touch : touches) normals_.col(touch.vertex).setZero();
}

double StrainLimitPass::largest_excess(const Positions& positions) const {
  double largest = 0;
  const auto include = [&](const auto& edge) {
    if (inverse_mass(edge.ends) == 0) return;
    const double share = edge.ends.difference(positions).norm() / edge.rest_length;
    largest = std::max({largest, share - limits_.longest, limits_.shortest - share});
  };
  std::for_each(edges_.begin(), edges_.end(), include);
  std::for_each(shared_edges_.begin(), shared_edges_.end(), include);
  return largest;
}

bool StrainLimitPass::is_exceeded(const PositionsView& positions) const {
  const auto is_out = [&](const auto& edge) { return is_beyond(edge, positions); };
  return std::any_of(edges_.begin(), edges_.end(), is_out) ||
         std::any_of(shared_edges_.begin(), shared_edges_.end(), is_out);
}

}  // namespace pleat
