#include "core/dynamics/position_based/lanes/spring_program.h"

#include <functional>
#include <string_view>

namespace pleat {
namespace {

/// Share by which a line's diagonal is enlarged: a line stretches under its load by this share of
/// what projecting its springs one by one would leave, and contradicting pins pull it at most
/// 1/kLineSoftness times as hard.
constexpr float kLineSoftness = 1e-3f;
/// Largest pull f of a line, times twice the largest inverse mass in it. A pull moves vertices
/// across the line too, along directions from before the solution; from 1/2 on, waves across it
/// grow (docs/methods/xpbd.md). A spring alone reaches 1/4.
constexpr float kLargestPull = 0.3f;
/// Groups of four kept per spring of a line between elimination and substitution: its pull as far
/// as the rows before it say, the share of the next pull in it, its direction g, and what its
/// multiplier changes by per pull.
enum LineChannel { kSolution, kUpper, kDirection, kMultiplierShare = 5, kLineChannels };
constexpr int kLanes = Float4::kLanes;

using Block = SpringBlock;

std::size_t hash_of(const Block& block) {
  return std::hash<std::string_view>()({reinterpret_cast<const char*>(&block), sizeof block});
}

}  // namespace

SpringProgram::SpringProgram(const ClothModel& model, const LaneLayout& layout, SpringLaw law,
                             double h)
    : law_(law), h_(h), mean_mass_(model.masses.mean()) {
  SpringOrder order = order_springs(model, layout, free_springs(model));
  lines_ = std::move(order.lines);
  int n_in_lines = 0;
  int longest = 0;
  for (const SpringLine& line : lines_) {
    n_in_lines += line.n_springs;
    longest = std::max(longest, line.n_springs);
  }
  for (const LaneOperation& operation : order.operations) {
    const auto index = static_cast<int>(operations_.size());
    operations_.push_back({operation.first_slots[0], operation.first_slots[1], 0});
    members_.push_back(operation.members);
    if (index >= n_in_lines) append_to_stretches(stretches_, index, operation.first_slots, 2);
  }
  line_scratch_.resize(static_cast<std::size_t>(longest * kLineChannels * kLanes));
  multipliers_.resize(operations_.size() * static_cast<std::size_t>(kLanes));
  blocks_.reserve(operations_.size());
  fill_blocks(model);
}

Block SpringProgram::block_of(const ClothModel& model, const LaneMembers& members) const {
  Block block;
  for (std::size_t lane = 0; lane < members.size(); ++lane)
    if (members[lane] >= 0)
      block.set_lane(lane, model.springs[static_cast<std::size_t>(members[lane])], law_, h_,
                     mean_mass_);
  return block;
}

// Most operations of a regular sheet have equal numbers. A small table finds most of them, and then
// the numbers of the whole sheet stay in the nearest cache.
void SpringProgram::fill_blocks(const ClothModel& model) {
  constexpr std::size_t kRemembered = 256;
  constexpr std::size_t kProbes = 8;
  std::array<int, kRemembered> remembered;
  remembered.fill(-1);
  blocks_.clear();
  for (std::size_t i = 0; i < operations_.size(); ++i) {
    const Block block = block_of(model, members_[i]);
    const std::size_t hash = hash_of(block);
    const auto is_other = [&](int place) {
      return place >= 0 && !(blocks_[static_cast<std::size_t>(place)] == block);
    };
    std::size_t at = hash % kRemembered;
    for (std::size_t probe = 1; probe < kProbes && is_other(remembered[at]); ++probe)
      at = (hash + probe) % kRemembered;
    if (remembered[at] < 0 || is_other(remembered[at])) {
      remembered[at] = static_cast<int>(blocks_.size());
      blocks_.push_back(block);
    }
    operations_[i].block = remembered[at];
  }
}

float* SpringProgram::line_scratch(int row, int channel) {
  return line_scratch_.data() + (row * kLineChannels + channel) * kLanes;
}

// All springs of a line at once. The length of spring r changes with the pulls f_{r-1}, f_r,
// f_{r+1}:
//   - w_r (d_r.g_{r-1}) f_{r-1} + slope_r (w_r + w_{r+1} + alpha_r) f_r
//   - w_{r+1} (d_r.g_{r+1}) f_{r+1} = aim_r,
// solved by elimination from the first end, substitution from the last. A line held at both ends
// and drawn tight has one pull too many: kLineSoftness keeps the pulls bounded.
template <SpringLaw law, bool first>
void SpringProgram::solve_line(const LaneView& v, const SpringLine& line) {
  const Float4 w_largest = eliminate<law, first>(v, line);
  substitute<law, first>(v, line, Float4::all(0.5f * kLargestPull) / w_largest);
}

/// Leaves per row what substitution needs. Returns the largest inverse mass of the line.
template <SpringLaw law, bool first>
Float4 SpringProgram::eliminate(const LaneView& v, const SpringLine& line) {
  const Operation* const operations = operations_.data() + line.first;
  const float* const multipliers = multipliers_.data() + kLanes * line.first;
  const Float4 zero = Float4::all(0);
  const int start = operations[0].a;
  Vec3Lanes<Float4> begin_a = load<Float4>(v.begins, start);
  Vec3Lanes<Float4> move_a = load<Float4>(v.moves, start);
  Float4 w_a = Float4::load(v.inverse_masses + start);
  Vec3Lanes<Float4> d_before{zero, zero, zero};
  Vec3Lanes<Float4> g_before = d_before;
  Float4 inverse_pivot = zero;
  Float4 solution = zero;
  Float4 w_largest = w_a + Float4::all(kRigidCompliance);
  for (int row = 0; row < line.n_springs; ++row) {
    const Block& block = blocks_[static_cast<std::size_t>(operations[row].block)];
    const int b = operations[row].b;
    const Vec3Lanes<Float4> begin_b = load<Float4>(v.begins, b);
    const Vec3Lanes<Float4> move_b = load<Float4>(v.moves, b);
    const Float4 w_b = Float4::load(v.inverse_masses + b);
    const auto spring = linearise<Float4, law, first>(begin_a - begin_b, move_a - move_b, block, 0,
                                                      multipliers + kLanes * row);
    const Float4 diagonal = spring.slope * (Float4::all(1 + kLineSoftness) * (w_a + w_b) +
                                            Float4::load(block.denominator_share.data()));
    const Float4 lower = w_a * dot(spring.d, g_before);
    const Float4 upper = w_a * dot(d_before, spring.g) * inverse_pivot;
    if (row > 0) upper.store(line_scratch(row - 1, kUpper));
    inverse_pivot =
        Float4::all(1.0f) / max(diagonal - lower * upper, Float4::all(kLineSoftness) * diagonal);
    solution = (spring.aim + lower * solution) * inverse_pivot;
    solution.store(line_scratch(row, kSolution));
    spring.g.x.store(line_scratch(row, kDirection));
    spring.g.y.store(line_scratch(row, kDirection + 1));
    spring.g.z.store(line_scratch(row, kDirection + 2));
    if constexpr (law != SpringLaw::rigid)
      (spring.slope / spring.length).store(line_scratch(row, kMultiplierShare));
    begin_a = begin_b;
    move_a = move_b;
    w_a = w_b;
    w_largest = max(w_largest, w_b);
    d_before = spring.d;
    g_before = spring.g;
  }
  zero.store(line_scratch(line.n_springs - 1, kUpper));
  return w_largest;
}

template <SpringLaw law, bool first>
void SpringProgram::substitute(const LaneView& v, const SpringLine& line, Float4 largest_pull) {
  const Operation* const operations = operations_.data() + line.first;
  float* const multipliers = multipliers_.data() + kLanes * line.first;
  const Float4 zero = Float4::all(0);
  const auto kept = [&](int row, int channel) { return Float4::load(line_scratch(row, channel)); };
  Float4 f = zero;
  Vec3Lanes<Float4> pull_after{zero, zero, zero};
  for (int row = line.n_springs - 1; row >= 0; --row) {
    const int b = operations[row].b;
    f = kept(row, kSolution) + kept(row, kUpper) * f;
    f = max(min(f, largest_pull), zero - largest_pull);
    const Vec3Lanes<Float4> pull =
        f * Vec3Lanes<Float4>{kept(row, kDirection), kept(row, kDirection + 1),
                              kept(row, kDirection + 2)};
    if constexpr (law != SpringLaw::rigid)
      add_to_multiplier<first>(f * kept(row, kMultiplierShare), multipliers + kLanes * row);
    store(load<Float4>(v.moves, b) + Float4::load(v.inverse_masses + b) * (pull_after - pull),
          v.moves, b);
    pull_after = pull;
  }
  const int start = operations[0].a;
  store(load<Float4>(v.moves, start) + Float4::load(v.inverse_masses + start) * pull_after, v.moves,
        start);
}

template <SpringLaw law, bool first>
void SpringProgram::project(const LaneView& view) {
  const LaneView v = view;
  const Operation* const operations = operations_.data();
  const Block* const blocks = blocks_.data();
  float* const multipliers = multipliers_.data();
  for_each_operation(stretches_, members_, [=](int index, int lane, auto lanes) {
    using Lanes = decltype(lanes);
    const int a = operations[index].a + lane;
    const int b = operations[index].b + lane;
    const Block& block = blocks[operations[index].block];
    float* const multiplier = multipliers + kLanes * index + lane;
    const Vec3Lanes<Lanes> move_a = load<Lanes>(v.moves, a);
    const Vec3Lanes<Lanes> move_b = load<Lanes>(v.moves, b);
    const Vec3Lanes<Lanes> change_of_d = move_a - move_b;
    const Vec3Lanes<Lanes> d_begin = load<Lanes>(v.begins, a) - load<Lanes>(v.begins, b);
    const Lanes w_a = Lanes::load(v.inverse_masses + a);
    const Lanes w_b = Lanes::load(v.inverse_masses + b);
    const Vec3Lanes<Lanes> pull =
        pull_of<Lanes, law, first>(d_begin, change_of_d, w_a + w_b, block, lane, multiplier);
    store(move_a + w_a * pull, v.moves, a);
    store(move_b - w_b * pull, v.moves, b);
  });
}

template <SpringLaw law, bool first>
void SpringProgram::sweep(const LaneView& view) {
  for (const SpringLine& line : lines_) solve_line<law, first>(view, line);
  project<law, first>(view);
}

void SpringProgram::sweep(const LaneView& view, bool is_first) {
  with_law(law_, [&](auto law) {
    constexpr SpringLaw kLaw = decltype(law)::value;
    is_first ? sweep<kLaw, true>(view) : sweep<kLaw, false>(view);
  });
}

double SpringProgram::squared_residual(const LaneView& v) const {
  return with_law(law_, [&](auto constant) {
    constexpr SpringLaw kLaw = decltype(constant)::value;
    Float4 sum = Float4::all(0);
    const float* multiplier = multipliers_.data();
    for (const auto& [a, b, index] : operations_) {
      sum = sum + squared_error<Float4, kLaw>(load<Float4>(v.begins, a) - load<Float4>(v.begins, b),
                                              load<Float4>(v.moves, a) - load<Float4>(v.moves, b),
                                              blocks_[static_cast<std::size_t>(index)], 0,
                                              multiplier);
      multiplier += kLanes;
    }
    return sum_of_lanes<double>(sum);
  });
}

}  // namespace pleat
