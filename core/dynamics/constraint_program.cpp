#include "core/dynamics/constraint_program.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <tuple>

#include "core/base/check.h"
#include "core/dynamics/simd4.h"

namespace pleat {
namespace {

/// Compliance of a rigid constraint, relative to the inverse masses: far below what their sum
/// rounds off, but a denominator that never is zero, even between two pinned vertices.
constexpr float kRigid = 1e-12f;
constexpr float kEmpty = std::numeric_limits<float>::infinity();
/// Added where a length [m] may be zero, as a square [m^2].
constexpr float kTinySquare = 1e-30f;
/// Rows whose work along the row is interleaved. Along a row every operation waits for the one
/// before it; four rows hide that wait.
constexpr int kPanelRows = 4;
/// Share of the new direction in the direction along which a constraint moves its vertices; the
/// rest is the direction at the substep's begin. See docs/methods/xpbd.md: 0 is second order and
/// undamped, 1 is first order and damps.
constexpr float kNewDirection = 0.25f;

template <class Lanes>
Vec3Lanes<Lanes> load(const std::array<float*, 3>& arrays, int slot) {
  return {Lanes::load(arrays[0] + slot), Lanes::load(arrays[1] + slot),
          Lanes::load(arrays[2] + slot)};
}
template <class Lanes>
Vec3Lanes<Lanes> load(const std::array<const float*, 3>& arrays, int slot) {
  return {Lanes::load(arrays[0] + slot), Lanes::load(arrays[1] + slot),
          Lanes::load(arrays[2] + slot)};
}
template <class Lanes>
void store(const Vec3Lanes<Lanes>& value, const std::array<float*, 3>& arrays, int slot) {
  value.x.store(arrays[0] + slot);
  value.y.store(arrays[1] + slot);
  value.z.store(arrays[2] + slot);
}

/// Where an operation stands in a sweep, and what it touches.
struct Candidate {
  std::array<int, 3> first_slots;  // of the groups it works on; the third is unused for springs
  int lane = 0;
  int element = 0;  // spring or bending element
  std::array<int, 5> rank;
};

/// Diagonals first, then along the rows, then across them, where each of these may look only a few
/// rows ahead: the order is the same as with three passes over the cloth, but a row is still in the
/// cache when it is needed again. Within a pair of rows the diagonals of every second column come
/// first, so that none waits for its neighbour.
std::array<int, 5> spring_rank(const LaneLayout& layout, const LaneLayout::Place& a,
                               const LaneLayout::Place& b) {
  const int column = std::min(a.column, b.column) % layout.stride;
  if (a.row == b.row) return {a.row / kPanelRows, 1, column, a.row, 0};
  if (a.column == b.column) return {b.row / kPanelRows, 2, a.row, column, 0};
  return {a.row / kPanelRows, 0, a.row, column % 2, column};
}

/// Puts candidates that touch the same groups into the lanes of one operation and orders these.
/// `append(candidate, is_new)` is called for each candidate, those of an operation in a row.
template <class Append>
void compile(std::vector<Candidate>& candidates, Append&& append) {
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& p, const Candidate& q) {
    return std::tie(p.first_slots, p.lane, p.element) < std::tie(q.first_slots, q.lane, q.element);
  });
  std::vector<std::pair<std::size_t, std::size_t>> groups;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const bool joins = i > 0 && candidates[i].first_slots == candidates[i - 1].first_slots &&
                       candidates[i].lane > candidates[i - 1].lane;
    if (!joins) groups.emplace_back(i, i);
    groups.back().second = i + 1;
  }
  std::sort(groups.begin(), groups.end(), [&](const auto& p, const auto& q) {
    const Candidate& a = candidates[p.first];
    const Candidate& b = candidates[q.first];
    return std::tie(a.rank, a.first_slots, a.element) < std::tie(b.rank, b.first_slots, b.element);
  });
  for (const auto& [begin, end] : groups)
    for (std::size_t i = begin; i < end; ++i) append(candidates[i], i == begin);
}

bool apart(int a, int b) { return std::abs(a - b) >= Float4::kLanes; }

template <class Stretches>
void append_to_stretches(Stretches& stretches, int operation, bool whole) {
  if (stretches.empty() || stretches.back().whole != whole)
    stretches.push_back({operation, operation, whole});
  stretches.back().end = operation + 1;
}

/// Source: Fowler, Noll & Vo, hash FNV-1a.
std::size_t hash_of(const std::array<float, 4>& first, const std::array<float, 4>& second) {
  std::uint32_t hash = 2166136261u;
  for (const auto* lanes : {&first, &second})
    for (float value : *lanes) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      for (int shift = 0; shift < 32; shift += 8)
        hash = (hash ^ ((bits >> shift) & 0xff)) * 16777619u;
    }
  return hash;
}

SpringLaw law_of(const ClothModel& model, bool rigid) {
  if (rigid) return SpringLaw::rigid;
  const bool damped = std::any_of(model.springs.begin(), model.springs.end(),
                                  [](const Spring& spring) { return spring.damping > 0; });
  if (!damped) return SpringLaw::elastic;
  return model.damping_direction == DampingDirection::isotropic ? SpringLaw::damped_isotropic
                                                                : SpringLaw::damped;
}

/// Calls work(operation, lane) for the occupied lanes of operations begin to end.
template <class Members, class Work>
void for_each_lane(const Members& members, int begin, int end, Work&& work) {
  for (int i = begin; i < end; ++i)
    for (int lane = 0; lane < Float4::kLanes; ++lane)
      if (members[static_cast<std::size_t>(i)][static_cast<std::size_t>(lane)] >= 0) work(i, lane);
}

/// Calls work(operation, lane, number of lanes as a type) over all stretches, in order.
template <class Stretches, class Members, class Work>
void for_each_operation(const Stretches& stretches, const Members& members, Work&& work) {
  for (const auto& stretch : stretches) {
    if (stretch.whole) {
      for (int i = stretch.begin; i < stretch.end; ++i) work(i, 0, Float4{});
    } else {
      for_each_lane(members, stretch.begin, stretch.end,
                    [&](int i, int lane) { work(i, lane, Float1{}); });
    }
  }
}

}  // namespace

ConstraintProgram::ConstraintProgram(const ClothModel& model, const LaneLayout& layout, bool rigid,
                                     double h)
    : law_(law_of(model, rigid)), h_(h), mean_mass_(model.masses.mean()) {
  compile_springs(model, layout);
  compile_bends(model, layout);
}

void ConstraintProgram::compile_springs(const ClothModel& model, const LaneLayout& layout) {
  std::vector<Candidate> candidates;
  for (std::size_t s = 0; s < model.springs.size(); ++s) {
    const Spring& spring = model.springs[s];
    if (spring.stiffness == 0 && (law_ == SpringLaw::rigid || spring.damping == 0)) continue;
    const LaneLayout::Place* a = &layout.places[static_cast<std::size_t>(spring.a)];
    const LaneLayout::Place* b = &layout.places[static_cast<std::size_t>(spring.b)];
    if (std::tie(b->row, b->column) < std::tie(a->row, a->column)) std::swap(a, b);
    const int lane = a->slot % kLanes;
    candidates.push_back({{a->slot - lane, b->slot - lane, 0},
                          lane,
                          static_cast<int>(s),
                          spring_rank(layout, *a, *b)});
  }
  compile(candidates, [&](const Candidate& candidate, bool is_new) {
    if (is_new) {
      const auto [a, b, unused] = candidate.first_slots;
      append_to_stretches(spring_stretches_, static_cast<int>(springs_.size()), apart(a, b));
      springs_.push_back({a, b, 0});
      spring_members_.push_back({-1, -1, -1, -1});
    }
    spring_members_.back()[static_cast<std::size_t>(candidate.lane)] = candidate.element;
  });
  spring_blocks_.reserve(springs_.size());
  if (law_ != SpringLaw::rigid)
    spring_multipliers_.resize(springs_.size() * (law_ == SpringLaw::damped_isotropic ? 16 : 4));
  fill_spring_blocks(model);
}

void ConstraintProgram::compile_bends(const ClothModel& model, const LaneLayout& layout) {
  std::vector<Candidate> candidates;
  for (std::size_t e = 0; e < model.bends.size(); ++e) {
    const BendElement& bend = model.bends[e];
    if (bend.stiffness == 0 || bend.weights[1] == 0) continue;
    const auto place = [&](int k) -> const LaneLayout::Place& {
      return layout.places[static_cast<std::size_t>(bend.vertices[static_cast<std::size_t>(k)])];
    };
    const int lane = place(0).slot % kLanes;
    const int along = place(0).row == place(2).row ? 1 : 0;
    const int column = layout.piece_column(place(0));
    candidates.push_back({{place(0).slot - lane, place(1).slot - lane, place(2).slot - lane},
                          lane,
                          static_cast<int>(e),
                          {place(0).row / kPanelRows, along, along ? column : place(0).row,
                           along ? place(0).row : column, 0}});
  }
  compile(candidates, [&](const Candidate& candidate, bool is_new) {
    if (is_new) {
      const auto [before, middle, after] = candidate.first_slots;
      append_to_stretches(bend_stretches_, static_cast<int>(bends_.size()),
                          apart(before, middle) && apart(middle, after) && apart(before, after));
      bends_.push_back({before, middle, after});
      bend_members_.push_back({-1, -1, -1, -1});
      bend_blocks_.push_back({{}, {}, {}, {kEmpty, kEmpty, kEmpty, kEmpty}});
    }
    const auto lane = static_cast<std::size_t>(candidate.lane);
    bend_members_.back()[lane] = candidate.element;
    const BendElement& bend = model.bends[static_cast<std::size_t>(candidate.element)];
    const double middle = bend.weights[1];
    const double stiffness = bend.stiffness * middle * middle;  // [N/m]
    BendBlock& block = bend_blocks_.back();
    block.before[lane] = static_cast<float>(bend.weights[0] / std::abs(middle));
    block.after[lane] = static_cast<float>(bend.weights[2] / std::abs(middle));
    block.compliance[lane] = static_cast<float>(mean_mass_ / (stiffness * h_ * h_));
    block.denominator_share[lane] = block.compliance[lane] + kRigid;
  });
  bend_multipliers_.resize(bends_.size() * 12);
}

ConstraintProgram::SpringBlock ConstraintProgram::spring_block(const ClothModel& model,
                                                               const Members& members) const {
  SpringBlock block;
  block.rest.fill(1);
  block.compliance.fill(0);
  block.denominator_share.fill(kEmpty);
  block.damper_share.fill(0);
  block.damper_compliance.fill(kEmpty);
  for (std::size_t lane = 0; lane < members.size(); ++lane) {
    if (members[lane] < 0) continue;
    const Spring& spring = model.springs[static_cast<std::size_t>(members[lane])];
    const double rest = spring.rest_length;
    if (law_ == SpringLaw::rigid) {
      block.rest[lane] = std::max(static_cast<float>(0.5 * rest * rest), kTinySquare);
      block.denominator_share[lane] = kRigid;
      continue;
    }
    const double damper = law_ == SpringLaw::elastic ? 0 : spring.damping / h_;
    const double stiffness = spring.stiffness + damper;  // [N/m]
    block.rest[lane] = static_cast<float>(rest);
    if (stiffness > 0) {
      block.compliance[lane] = static_cast<float>(mean_mass_ / (stiffness * h_ * h_));
      block.denominator_share[lane] = block.compliance[lane] + kRigid;
      block.damper_share[lane] = static_cast<float>(damper / stiffness);
    }
    if (law_ == SpringLaw::damped_isotropic && spring.damping > 0)
      block.damper_compliance[lane] = static_cast<float>(mean_mass_ / (spring.damping * h_));
  }
  return block;
}

// Most operations of a regular sheet have equal numbers. A small table finds most of them, and then
// the numbers of the whole sheet stay in the nearest cache.
void ConstraintProgram::fill_spring_blocks(const ClothModel& model) {
  constexpr std::size_t kRemembered = 256;
  constexpr std::size_t kProbes = 8;
  std::array<int, kRemembered> remembered;
  remembered.fill(-1);
  spring_blocks_.clear();
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const SpringBlock block = spring_block(model, spring_members_[i]);
    const std::size_t hash = hash_of(block.rest, block.denominator_share);
    const auto is_here = [&](int place) {
      return place < 0 || spring_blocks_[static_cast<std::size_t>(place)] == block;
    };
    std::size_t at = hash % kRemembered;
    for (std::size_t probe = 1; probe < kProbes && !is_here(remembered[at]); ++probe)
      at = (hash + probe) % kRemembered;
    if (remembered[at] < 0 || !is_here(remembered[at])) {
      remembered[at] = static_cast<int>(spring_blocks_.size());
      spring_blocks_.push_back(block);
    }
    springs_[i].block = remembered[at];
  }
}

void ConstraintProgram::refresh_rest_lengths(const ClothModel& model) { fill_spring_blocks(model); }

void ConstraintProgram::compute_lane_by_lane() {
  spring_stretches_.assign(1, {0, static_cast<int>(springs_.size()), false});
  bend_stretches_.assign(1, {0, static_cast<int>(bends_.size()), false});
}

// With d = x_a - x_b at the end of the substep, d_begin at its begin, and the pull acting along
// g = d_begin + kNewDirection (d - d_begin), corrections x_a += w_a f g, x_b -= w_b f g change the
// length l = |d| by f (w_a + w_b) d.g/l.
//   rigid:   (l^2 - L^2)/2 + f (w_a + w_b) d.g = 0
//   elastic: l - L + alpha lambda = 0, with lambda the multiplier and f = dlambda l/(d.g)
// d.g is held above L^2/2 or l^2/2: below, the spring turned by more than 60 degrees within a
// substep or is squeezed to nothing, and the linearisation would throw it far over its aim.
template <SpringLaw law, bool first>
void ConstraintProgram::sweep_springs(const LaneView& view) {
  const LaneView v = view;
  const SpringOperation* const operations = springs_.data();
  const SpringBlock* const blocks = spring_blocks_.data();
  float* const multipliers = spring_multipliers_.data();
  for_each_operation(spring_stretches_, spring_members_, [&](int index, int lane, auto lanes) {
    using Lanes = decltype(lanes);
    const int a = operations[index].a + lane;
    const int b = operations[index].b + lane;
    const SpringBlock& block = blocks[operations[index].block];
    const Lanes half = Lanes::all(0.5f);
    const Vec3Lanes<Lanes> move_a = load<Lanes>(v.moves, a);
    const Vec3Lanes<Lanes> move_b = load<Lanes>(v.moves, b);
    const Vec3Lanes<Lanes> change_of_d = move_a - move_b;
    const Vec3Lanes<Lanes> d_begin = load<Lanes>(v.begins, a) - load<Lanes>(v.begins, b);
    const Lanes w_a = Lanes::load(v.inverse_masses + a);
    const Lanes w_b = Lanes::load(v.inverse_masses + b);
    const Lanes w = w_a + w_b;

    const Vec3Lanes<Lanes> d = d_begin + change_of_d;
    const Vec3Lanes<Lanes> g = d_begin + Lanes::all(kNewDirection) * change_of_d;
    const Lanes square = dot(d, d);
    const Lanes rest = Lanes::load(block.rest.data() + lane);
    const Lanes softness = w + Lanes::load(block.denominator_share.data() + lane);
    Lanes f;
    if constexpr (law == SpringLaw::rigid) {
      f = (rest - half * square) / (max(dot(d, g), max(rest, half * square)) * softness);
    } else {
      const Lanes tiny = Lanes::all(kTinySquare);
      const Lanes length = sqrt(max(square, tiny));
      Lanes target = rest;
      if constexpr (law != SpringLaw::elastic) {
        const Lanes length_begin = sqrt(dot(d_begin, d_begin));
        target = rest + Lanes::load(block.damper_share.data() + lane) * (length_begin - rest);
      }
      float* const multiplier =
          multipliers + (law == SpringLaw::damped_isotropic ? 16 : 4) * index + lane;
      Lanes change = target - length;
      if constexpr (!first) {
        const Lanes last = Lanes::load(multiplier);
        change = (change - Lanes::load(block.compliance.data() + lane) * last) / softness;
        (last + change).store(multiplier);
      } else {
        change = change / softness;
        change.store(multiplier);
      }
      f = change * length / max(dot(d, g), max(half * square, tiny));
    }
    Vec3Lanes<Lanes> pull = f * g;
    if constexpr (law == SpringLaw::damped_isotropic) {
      // Across the spring: C = t + alpha mu, t = change_of_d - u (u.change_of_d), linear.
      const Lanes square_or_one = max(square, Lanes::all(kTinySquare));
      const Vec3Lanes<Lanes> across = change_of_d - (dot(d, change_of_d) / square_or_one) * d;
      const Lanes gain =
          Lanes::all(1.0f) / (w + Lanes::load(block.damper_compliance.data() + lane));
      Vec3Lanes<Lanes> change = (Lanes::all(0.0f) - gain) * across;
      float* const multiplier = multipliers + 16 * index + 4 + lane;
      Vec3Lanes<Lanes> sum = change;
      if constexpr (!first) {
        const Vec3Lanes<Lanes> last{Lanes::load(multiplier), Lanes::load(multiplier + 4),
                                    Lanes::load(multiplier + 8)};
        // gain * compliance = 1 - gain w, without infinity times zero in empty lanes
        change = change - (Lanes::all(1.0f) - gain * w) * last;
        sum = last + change;
      }
      sum.x.store(multiplier);
      sum.y.store(multiplier + 4);
      sum.z.store(multiplier + 8);
      pull = pull + change;
    }
    store(move_a + w_a * pull, v.moves, a);
    store(move_b - w_b * pull, v.moves, b);
  });
}

// C = b_0 (x_0 - x_1) + b_2 (x_2 - x_1), a vector; each component is a linear constraint of its own
// with the same denominator.
template <bool first>
void ConstraintProgram::sweep_bends(const LaneView& view) {
  const LaneView v = view;
  for_each_operation(bend_stretches_, bend_members_, [&](int index, int lane, auto lanes) {
    using Lanes = decltype(lanes);
    const BendOperation& operation = bends_[static_cast<std::size_t>(index)];
    const BendBlock& block = bend_blocks_[static_cast<std::size_t>(index)];
    const int before = operation.before + lane;
    const int middle = operation.middle + lane;
    const int after = operation.after + lane;
    const Lanes b_0 = Lanes::load(block.before.data() + lane);
    const Lanes b_2 = Lanes::load(block.after.data() + lane);
    const Lanes b_1 = b_0 + b_2;
    const Vec3Lanes<Lanes> move_0 = load<Lanes>(v.moves, before);
    const Vec3Lanes<Lanes> move_1 = load<Lanes>(v.moves, middle);
    const Vec3Lanes<Lanes> move_2 = load<Lanes>(v.moves, after);
    const Vec3Lanes<Lanes> begin_1 = load<Lanes>(v.begins, middle);
    const Vec3Lanes<Lanes> d_0 = (load<Lanes>(v.begins, before) - begin_1) + (move_0 - move_1);
    const Vec3Lanes<Lanes> d_2 = (load<Lanes>(v.begins, after) - begin_1) + (move_2 - move_1);
    const Lanes w_0 = Lanes::load(v.inverse_masses + before) * b_0;
    const Lanes w_1 = Lanes::load(v.inverse_masses + middle) * b_1;
    const Lanes w_2 = Lanes::load(v.inverse_masses + after) * b_2;
    Vec3Lanes<Lanes> value = b_0 * d_0 + b_2 * d_2;
    float* const multiplier = bend_multipliers_.data() + 12 * index + lane;
    Vec3Lanes<Lanes> last{};
    if constexpr (!first) {
      last = {Lanes::load(multiplier), Lanes::load(multiplier + 4), Lanes::load(multiplier + 8)};
      value = value + Lanes::load(block.compliance.data() + lane) * last;
    }
    const Lanes gain = Lanes::all(-1.0f) / (w_0 * b_0 + w_1 * b_1 + w_2 * b_2 +
                                            Lanes::load(block.denominator_share.data() + lane));
    const Vec3Lanes<Lanes> change = gain * value;
    const Vec3Lanes<Lanes> sum = first ? change : last + change;
    sum.x.store(multiplier);
    sum.y.store(multiplier + 4);
    sum.z.store(multiplier + 8);
    store(move_0 + w_0 * change, v.moves, before);
    store(move_1 - w_1 * change, v.moves, middle);
    store(move_2 + w_2 * change, v.moves, after);
  });
}

template <bool first>
void ConstraintProgram::sweep(const LaneView& view) {
  sweep_bends<first>(view);
  switch (law_) {
    case SpringLaw::rigid:
      return sweep_springs<SpringLaw::rigid, first>(view);
    case SpringLaw::elastic:
      return sweep_springs<SpringLaw::elastic, first>(view);
    case SpringLaw::damped:
      return sweep_springs<SpringLaw::damped, first>(view);
    case SpringLaw::damped_isotropic:
      return sweep_springs<SpringLaw::damped_isotropic, first>(view);
  }
}

void ConstraintProgram::first_sweep(const LaneView& view) { sweep<true>(view); }
void ConstraintProgram::next_sweep(const LaneView& view) { sweep<false>(view); }

double ConstraintProgram::residual(const LaneView& view) const { return residual(view, true); }
double ConstraintProgram::residual_before_sweeps(const LaneView& view) const {
  return residual(view, false);
}

double ConstraintProgram::residual(const LaneView& v, bool with_multipliers) const {
  double sum = 0;
  const auto difference = [](const auto& arrays, int p, int q) {
    return Vec3(arrays[0][p] - arrays[0][q], arrays[1][p] - arrays[1][q],
                arrays[2][p] - arrays[2][q]);
  };
  for_each_lane(spring_members_, 0, static_cast<int>(springs_.size()), [&](int index, int lane) {
    const SpringOperation& operation = springs_[static_cast<std::size_t>(index)];
    const SpringBlock& block = spring_blocks_[static_cast<std::size_t>(operation.block)];
    const auto k = static_cast<std::size_t>(lane);
    const Vec3 d_begin = difference(v.begins, operation.a + lane, operation.b + lane);
    const Vec3 change_of_d = difference(v.moves, operation.a + lane, operation.b + lane);
    const Vec3 d = d_begin + change_of_d;
    if (law_ == SpringLaw::rigid) {
      const double error = d.norm() - std::sqrt(2.0 * block.rest[k]);
      sum += error * error;
      return;
    }
    const int channels = law_ == SpringLaw::damped_isotropic ? 16 : 4;
    const float* const multiplier = spring_multipliers_.data() + channels * index + lane;
    double error =
        d.norm() - block.rest[k] - block.damper_share[k] * (d_begin.norm() - block.rest[k]);
    if (with_multipliers) error += static_cast<double>(block.compliance[k]) * multiplier[0];
    sum += error * error;
    if (law_ != SpringLaw::damped_isotropic || !std::isfinite(block.damper_compliance[k])) return;
    Vec3 motion = change_of_d - d.dot(change_of_d) / std::max(d.squaredNorm(), 1e-30) * d;
    if (with_multipliers)
      motion += static_cast<double>(block.damper_compliance[k]) *
                Vec3(multiplier[4], multiplier[8], multiplier[12]);
    sum += motion.squaredNorm();
  });
  for_each_lane(bend_members_, 0, static_cast<int>(bends_.size()), [&](int index, int lane) {
    const BendOperation& bend = bends_[static_cast<std::size_t>(index)];
    const BendBlock& block = bend_blocks_[static_cast<std::size_t>(index)];
    const auto k = static_cast<std::size_t>(lane);
    const auto d = [&](int from_middle) -> Vec3 {
      return difference(v.begins, from_middle + lane, bend.middle + lane) +
             difference(v.moves, from_middle + lane, bend.middle + lane);
    };
    Vec3 error = block.before[k] * d(bend.before) + block.after[k] * d(bend.after);
    const float* const multiplier = bend_multipliers_.data() + 12 * index + lane;
    if (with_multipliers)
      error += static_cast<double>(block.compliance[k]) *
               Vec3(multiplier[0], multiplier[4], multiplier[8]);
    sum += error.squaredNorm();
  });
  return std::sqrt(sum);
}

}  // namespace pleat
