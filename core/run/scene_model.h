#pragma once

#include <string>
#include <vector>

#include "core/scene/rest_cloth.h"

namespace pleat {

/// The equations of motion that a scene asks for, and nothing else.
///
/// cloth  the scene's, at rest
/// Throws InputError for a fabric whose shear the cells cannot carry.
ClothModel scene_model(const Scene& scene, const RestCloth& cloth);

/// The state at time 0.
State scene_state(const RestCloth& cloth);

/// Parts that scene_model built, and those left out as the scene does not ask for them.
struct BuildReport {
  std::vector<std::string> built;
  std::vector<std::size_t> bytes;  ///< memory of each part built, without what steppers add
  std::vector<std::string> left_out;
};

/// options  what the scene asks of its model beyond the equations of motion
BuildReport build_report(const ClothModel& model, const ModelOptions& options);

}  // namespace pleat
