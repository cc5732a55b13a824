#include "core/dynamics/implicit/stepper_imex.h"

#include <string>

#include "core/base/check.h"
#include "core/model/elasticity.h"

namespace pleat {
namespace {

bool has_share(const ClothModel& model, const MethodOptions& options, int substeps) {
  return explicit_share(model, options.step / substeps) >= options.explicit_share;
}

}  // namespace

int imex_substeps(const ClothModel& model, const MethodOptions& options) {
  int too_few = options.substeps - 1;
  int enough = options.substeps;
  if (options.explicit_share == 0) return enough;
  if (options.split == ImplicitSplit::structural)
    throw InputError("/method/explicit_share",
                     "expected no such key beside \"split\": \"structural\", which takes the same "
                     "springs whatever the substeps");
  while (!has_share(model, options, enough)) {
    if (enough > kMaxSubsteps / 2)
      throw InputError("/method/explicit_share",
                       "expected a share that " + std::to_string(kMaxSubsteps) +
                           " substeps or fewer make explicit, got one that needs more");
    too_few = enough;
    enough *= 2;
  }
  while (enough - too_few > 1) {
    const int middle = too_few + (enough - too_few) / 2;
    (has_share(model, options, middle) ? enough : too_few) = middle;
  }
  return enough;
}

StepperImex::StepperImex(ClothModel& model, const MethodOptions& options)
    : StepperImplicit(model, options, imex_substeps(model, options)) {
  choose();
}

void StepperImex::choose() {
  parts_ = options().split == ImplicitSplit::structural
               ? split_structural(model_)
               : split_by_stability(model_, options().step / substeps());
  take_implicitly(parts_.stiff);
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref is handed on to be written through.
void StepperImex::add_explicit_forces(const State& state, PositionsRef forces) const {
  add_internal_forces(parts_.soft, state.positions, state.velocities, forces);
}

}  // namespace pleat
