#include "core/dynamics/position_based/lanes/bend_program.h"

namespace pleat {
namespace {

constexpr int kMultiplierFloats = 12;

std::vector<LaneCandidate> candidates_of(const ClothModel& model,
                                         const std::vector<BendConstraint>& bends,
                                         const LaneLayout& layout) {
  std::vector<LaneCandidate> candidates;
  for (std::size_t e = 0; e < bends.size(); ++e) {
    const BendConstraint& bend = bends[e];
    if (any_hangs(model, bend.vertices)) continue;
    const auto place = [&](std::size_t k) {
      return layout.places[static_cast<std::size_t>(bend.vertices[k])];
    };
    const LaneLayout::Place first = place(0);
    const int lane = first.slot % Float4::kLanes;
    const int column = first.column % layout.stride;
    const int panel = first.row / kPanelRows;
    candidates.push_back({{first.slot - lane, place(1).slot - lane, place(2).slot - lane},
                          lane,
                          static_cast<int>(e),
                          first.row == place(2).row
                              ? std::array<int, 5>{panel, 1, column, first.row, 0}
                              : std::array<int, 5>{panel, 0, first.row, column, 0}});
  }
  return candidates;
}

}  // namespace

BendProgram::BendProgram(const ClothModel& model, const LaneLayout& layout, double h) {
  const std::vector<BendConstraint> bends = bend_constraints(model, h);
  for (const LaneOperation& operation : compile_operations(candidates_of(model, bends, layout))) {
    append_to_stretches(stretches_, static_cast<int>(operations_.size()), operation.first_slots, 3);
    operations_.push_back(
        {operation.first_slots[0], operation.first_slots[1], operation.first_slots[2]});
    members_.push_back(operation.members);
    Block block;
    block.denominator_share.fill(kEmptyLane);
    for (std::size_t lane = 0; lane < operation.members.size(); ++lane) {
      if (operation.members[lane] < 0) continue;
      const BendConstraint& bend = bends[static_cast<std::size_t>(operation.members[lane])];
      block.before[lane] = static_cast<float>(bend.weights[0]);
      block.after[lane] = static_cast<float>(bend.weights[2]);
      block.compliance[lane] = bend.compliance;
      block.denominator_share[lane] = block.compliance[lane] + kRigidCompliance;
    }
    blocks_.push_back(block);
  }
  multipliers_.resize(operations_.size() * kMultiplierFloats);
}

// C = b_0 (x_0 - x_1) + b_2 (x_2 - x_1), a vector; each component is a linear constraint of its own
// with the same denominator.
template <bool first>
void BendProgram::sweep(const LaneView& view) {
  const LaneView v = view;
  for_each_operation(stretches_, members_, [&](int index, int lane, auto lanes) {
    using Lanes = decltype(lanes);
    const Operation& operation = operations_[static_cast<std::size_t>(index)];
    const Block& block = blocks_[static_cast<std::size_t>(index)];
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
    Vec3Lanes<Lanes> error = b_0 * d_0 + b_2 * d_2;
    float* const multiplier = multipliers_.data() + kMultiplierFloats * index + lane;
    if constexpr (!first)
      error = error + Lanes::load(block.compliance.data() + lane) *
                          Vec3Lanes<Lanes>{Lanes::load(multiplier), Lanes::load(multiplier + 4),
                                           Lanes::load(multiplier + 8)};
    const Lanes gain = Lanes::all(-1.0f) / (w_0 * b_0 + w_1 * b_1 + w_2 * b_2 +
                                            Lanes::load(block.denominator_share.data() + lane));
    const Vec3Lanes<Lanes> change = gain * error;
    add_to_multiplier<first>(change.x, multiplier);
    add_to_multiplier<first>(change.y, multiplier + 4);
    add_to_multiplier<first>(change.z, multiplier + 8);
    store(move_0 + w_0 * change, v.moves, before);
    store(move_1 - w_1 * change, v.moves, middle);
    store(move_2 + w_2 * change, v.moves, after);
  });
}

void BendProgram::sweep(const LaneView& view, bool is_first) {
  is_first ? sweep<true>(view) : sweep<false>(view);
}

double BendProgram::squared_residual(const LaneView& v) const {
  Float4 sum = Float4::all(0);
  for (std::size_t i = 0; i < operations_.size(); ++i) {
    const Operation& operation = operations_[i];
    const Block& block = blocks_[i];
    const auto place = [&](int slot) {
      return load<Float4>(v.begins, slot) - load<Float4>(v.begins, operation.middle) +
             (load<Float4>(v.moves, slot) - load<Float4>(v.moves, operation.middle));
    };
    const float* const multiplier = multipliers_.data() + kMultiplierFloats * i;
    const Vec3Lanes<Float4> error =
        Float4::load(block.before.data()) * place(operation.before) +
        Float4::load(block.after.data()) * place(operation.after) +
        Float4::load(block.compliance.data()) * Vec3Lanes<Float4>{Float4::load(multiplier),
                                                                  Float4::load(multiplier + 4),
                                                                  Float4::load(multiplier + 8)};
    sum = sum + dot(error, error);  // empty lanes have zero weights
  }
  return sum_of_lanes<double>(sum);
}

}  // namespace pleat
