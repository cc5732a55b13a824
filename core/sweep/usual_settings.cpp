#include "core/sweep/usual_settings.h"

#include "core/base/check.h"
#include "core/run/simulation.h"

namespace pleat {
namespace {

/// True when the stepper takes the scene, asked on its coarsest mesh.
bool takes(const StepperType& type, Scene scene) {
  scene.level = 0;
  scene.method = type.usual_method();
  try {
    Simulation(std::move(scene));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

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
  std::vector<const StepperType*> of_model;
  std::vector<const StepperType*> usual;
  for (const StepperType* type : steppers) {
    if (!(is_membrane ? type->is_usual_for_membranes : type->is_usual_for_springs)) continue;
    of_model.push_back(type);
    if (takes(*type, scene)) usual.push_back(type);
  }
  return usual.empty() ? of_model : usual;  // each row then says what is wrong with the scene
}

}  // namespace pleat
