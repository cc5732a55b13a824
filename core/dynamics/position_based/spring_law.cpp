#include "core/dynamics/position_based/spring_law.h"

#include <cmath>

namespace pleat {
namespace {

/// Slack beside the inverse masses of a diagonal's ends, 2 where masses are alike: 0.7 of its error
/// is corrected at a time. Both diagonals of a quad and its threads contradict each other. With
/// more, cloth shears more than measured fabric (docs/methods/multigrid.md).
constexpr float kDiagonalSlack = 0.857f;

}  // namespace

SpringLaw spring_law(Constraints constraints) {
  if (constraints == Constraints::rigid) return SpringLaw::rigid;
  if (constraints == Constraints::rigid_threads) return SpringLaw::rigid_threads;
  return SpringLaw::elastic;
}

std::vector<int> active_springs(const ClothModel& model) {
  std::vector<int> active;
  for (std::size_t s = 0; s < model.springs.size(); ++s)
    if (model.springs[s].stiffness > 0) active.push_back(static_cast<int>(s));
  return active;
}

std::vector<int> free_springs(const ClothModel& model) {
  std::vector<int> springs = active_springs(model);
  std::erase_if(springs, [&model](int s) {
    const Spring& spring = model.springs[static_cast<std::size_t>(s)];
    return model.hangs(spring.a) || model.hangs(spring.b);
  });
  return springs;
}

std::vector<BendConstraint> bend_constraints(const ClothModel& model, double h) {
  const double mean_mass = model.masses.mean();
  std::vector<BendConstraint> constraints;
  for (const BendElement& bend : model.bends) {
    const double middle = std::abs(bend.weights[1]);
    const double stiffness = bend.stiffness * middle * middle;  // [N/m]
    if (stiffness == 0) continue;
    constraints.push_back(
        {bend.vertices, bend.weights, static_cast<float>(mean_mass / (stiffness * h * h))});
    for (double& weight : constraints.back().weights) weight /= middle;
  }
  return constraints;
}

void SpringBlock::set_lane(std::size_t lane, const Spring& spring, SpringLaw law, double h,
                           double mean_mass) {
  const double length = spring.rest_length;
  if (is_rigid(law)) {
    const bool gives_way = law == SpringLaw::rigid_threads && spring.kind == SpringKind::shear;
    rest[lane] = std::max(static_cast<float>(length * length), kTinySquare);
    denominator_share[lane] = gives_way ? kDiagonalSlack : kRigidCompliance;
    return;
  }
  rest[lane] = static_cast<float>(length);
  compliance[lane] = static_cast<float>(mean_mass / (spring.stiffness * h * h));
  denominator_share[lane] = compliance[lane] + kRigidCompliance;
}

}  // namespace pleat
