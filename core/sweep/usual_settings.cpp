#include "core/sweep/usual_settings.h"

namespace pleat {

std::vector<MethodOptions> usual_settings(const StepperType& type,
                                          const MethodOptions& scene_method) {
  MethodOptions method = scene_method.stepper == &type ? scene_method : type.usual_method();
  method.step = scene_method.step;
  std::vector<MethodOptions> settings;
  for (const MethodCounts& counts : type.usual_counts) {
    settings.push_back(method);
    settings.back().substeps = counts.substeps;
    settings.back().iterations = counts.iterations;
  }
  return settings;
}

std::vector<const StepperType*> usual_steppers(StepperTable steppers, const Scene& scene) {
  const bool is_membrane = scene.model.elasticity == Elasticity::membrane;
  std::vector<const StepperType*> usual;
  for (const StepperType* type : steppers)
    if (is_membrane ? type->is_usual_for_membranes : type->is_usual_for_springs)
      usual.push_back(type);
  return usual;
}

}  // namespace pleat
