#include "core/dynamics/position_based/lanes/hanging_program.h"

#include <algorithm>

namespace pleat {
namespace {

Vec3Lanes<Float1> bend_error(const SlotSum& sum, const LaneView& view) {
  return value(sum, view.begins) + value(sum, view.moves);
}

Vec3Lanes<Float1> bend_error(const SlotSum& sum, float compliance, const float* multiplier,
                             const LaneView& view) {
  return bend_error(sum, view) +
         Float1{compliance} * Vec3Lanes<Float1>{{multiplier[0]}, {multiplier[1]}, {multiplier[2]}};
}

}  // namespace

HangingProgram::HangingProgram(const ClothModel& model, const LaneLayout& layout, SpringLaw law,
                               double h)
    : law_(law), h_(h), mean_mass_(model.masses.mean()) {
  if (model.hanging.empty()) return;
  constexpr std::array<double, 2> kDifference = {1, -1};
  const FreeCombinations in_free_vertices(model.n_vertices(), model.hanging);
  for (const int s : active_springs(model)) {
    const Spring& spring = model.springs[static_cast<std::size_t>(s)];
    const std::array ends{spring.a, spring.b};
    if (any_hangs(model, ends))
      springs_.push_back({sum_in_slots(in_free_vertices(ends, kDifference), layout), s, {}});
  }
  for (const BendConstraint& bend : bend_constraints(model, h))
    if (any_hangs(model, bend.vertices))
      bends_.push_back(
          {sum_in_slots(in_free_vertices(bend.vertices, bend.weights), layout), bend.compliance});
  spring_multipliers_.resize(springs_.size());
  bend_multipliers_.resize(3 * bends_.size());
  refresh_rest_lengths(model);
}

void HangingProgram::refresh_rest_lengths(const ClothModel& model) {
  for (JoinedSpring& joined : springs_)
    joined.block.set_lane(0, model.springs[static_cast<std::size_t>(joined.spring)], law_, h_,
                          mean_mass_);
}

template <bool first>
void HangingProgram::project_bends(const LaneView& view) {
  for (std::size_t i = 0; i < bends_.size(); ++i) {
    const auto& [sum, compliance] = bends_[i];
    float* const multiplier = bend_multipliers_.data() + 3 * i;
    const Vec3Lanes<Float1> error =
        first ? bend_error(sum, view) : bend_error(sum, compliance, multiplier, view);
    const Float1 gain = Float1{-1} / (inverse_mass_of(sum, view.inverse_masses) +
                                      Float1{compliance + kRigidCompliance});
    const Vec3Lanes<Float1> change = gain * error;
    add_to_multiplier<first>(change.x, multiplier);
    add_to_multiplier<first>(change.y, multiplier + 1);
    add_to_multiplier<first>(change.z, multiplier + 2);
    move_by(sum, change, view.inverse_masses, view.moves);
  }
}

template <SpringLaw law, bool first>
void HangingProgram::project_springs(const LaneView& view) {
  float* multiplier = spring_multipliers_.data();
  for (const JoinedSpring& spring : springs_) {
    const SlotSum& sum = spring.sum;
    move_by(sum,
            pull_of<Float1, law, first>(value(sum, view.begins), value(sum, view.moves),
                                        inverse_mass_of(sum, view.inverse_masses), spring.block, 0,
                                        multiplier),
            view.inverse_masses, view.moves);
    ++multiplier;
  }
}

template <bool first>
void HangingProgram::sweep(const LaneView& view) {
  project_bends<first>(view);
  with_law(law_, [&](auto law) { project_springs<decltype(law)::value, first>(view); });
}

void HangingProgram::sweep(const LaneView& view, bool is_first) {
  is_first ? sweep<true>(view) : sweep<false>(view);
}

void HangingProgram::forget() {
  std::fill(spring_multipliers_.begin(), spring_multipliers_.end(), 0.0f);
  std::fill(bend_multipliers_.begin(), bend_multipliers_.end(), 0.0f);
}

double HangingProgram::squared_residual(const LaneView& view) const {
  double total = 0;
  for (std::size_t i = 0; i < bends_.size(); ++i) {
    const auto& [sum, compliance] = bends_[i];
    const float* const multiplier = bend_multipliers_.data() + 3 * i;
    const Vec3Lanes<Float1> error = bend_error(sum, compliance, multiplier, view);
    total += dot(error, error).value;
  }
  with_law(law_, [&](auto law) {
    const float* multiplier = spring_multipliers_.data();
    for (const JoinedSpring& spring : springs_) {
      total += squared_error<Float1, decltype(law)::value>(value(spring.sum, view.begins),
                                                           value(spring.sum, view.moves),
                                                           spring.block, 0, multiplier)
                   .value;
      ++multiplier;
    }
  });
  return total;
}

}  // namespace pleat
