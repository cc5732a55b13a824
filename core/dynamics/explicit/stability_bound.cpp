#include "core/dynamics/explicit/stability_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "core/base/formatted.h"
#include "core/dynamics/stepper_type.h"
#include "core/model/elements.h"
#include "core/model/hanging_vertices.h"

namespace pleat {
namespace {

constexpr double kStepShare = 0.9;  // share of the bound, used when the substeps are ours to choose

[[noreturn]] void refuse(const char* format, double bound, double found, double enough) {
  throw InputError("/method/substeps", formatted(format, bound, found, enough));
}

}  // namespace

double largest_stable_step(const ClothModel& model) {
  RowSums sums{Eigen::VectorXd::Zero(model.n_vertices()),
               Eigen::VectorXd::Zero(model.n_vertices())};
  for_each_element_kind(model, [&sums](const auto& kind) { kind.add_row_sums(sums); });
  // A row of S^T K S adds up to at most what S^T makes of the sums, as rows of S add up to 1.
  pull_to_parents(model.hanging, sums.stiffness.transpose());
  pull_to_parents(model.hanging, sums.damping.transpose());
  // h^2 k + 2 h c = 2 m has the positive root h = 2 m / (c + sqrt(c^2 + 2 m k)).
  double bound = std::numeric_limits<double>::infinity();
  for (int i = 0; i < model.n_vertices(); ++i) {
    const double c = sums.damping[i];
    const double root = c + std::sqrt(c * c + 2 * model.masses[i] * sums.stiffness[i]);
    if (root > 0) bound = std::min(bound, 2 * model.masses[i] / root);
  }
  return bound;
}

double largest_forward_step(const ClothModel& model) {
  double bound = std::numeric_limits<double>::infinity();
  if (std::isinf(largest_stable_step(model))) return bound;
  if (!model.is_plain_spring_lattice() || !model.bends.empty() || !model.hanging.empty() ||
      model.damping_direction != DampingDirection::isotropic)
    return 0;
  Eigen::VectorXd dampings = Eigen::VectorXd::Zero(model.n_vertices());
  for (const Spring& spring : model.springs) {
    if (spring.stiffness > 0) bound = std::min(bound, spring.damping / spring.stiffness);
    dampings[spring.a] += spring.damping;
    dampings[spring.b] += spring.damping;
  }
  for (int i = 0; i < model.n_vertices(); ++i)
    if (dampings[i] > 0) bound = std::min(bound, model.masses[i] / dampings[i]);
  return bound;
}

double stability_bound(const ClothModel& model, const MethodOptions& options) {
  return options.euler == EulerRule::forward ? largest_forward_step(model)
                                             : largest_stable_step(model);
}

int stable_substeps(const ClothModel& model, const MethodOptions& options) {
  if (!model.hinges.empty())
    throw InputError("/model/bending", std::string("expected fitted or none with ") +
                                           options.stepper->name + ", got hinge");
  const bool goes_on = options.beyond_bound == BeyondBound::go_on;
  const double bound = stability_bound(model, options);
  if (bound == 0 && !(goes_on && options.substeps != kStableSubsteps))
    throw InputError("/method/euler",
                     "expected symplectic, as no substep is stable with forward unless the cloth "
                     "is of springs alone, each damped, with \"damping\": \"isotropic\"");
  const double enough = std::max(1.0, std::ceil(options.step / (kStepShare * bound)));
  if (options.substeps != kStableSubsteps) {
    const double h = options.step / options.substeps;
    if (h <= bound || goes_on) return options.substeps;
    refuse(
        "expected substeps of at most %.3g s, the stability bound of this cloth, got %.3g "
        "s (%.7g substeps would do)",
        bound, h, enough);
  }
  if (enough <= kMaxSubsteps) return static_cast<int>(enough);
  refuse(
      "expected cloth that is stable in substeps of %.3g s, got one that needs %.3g s "
      "(%.7g substeps)",
      options.step / kMaxSubsteps, bound, enough);
}

}  // namespace pleat
