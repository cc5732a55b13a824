#pragma once

#include <optional>
#include <vector>

#include "core/scene/scene.h"

namespace pleat {

/// The refined mesh of a sheet; none for inline particles.
std::optional<QuadMesh> scene_mesh(const Scene& scene);

/// The equations of motion that a scene asks for, and nothing else.
///
/// mesh       of scene_mesh(scene), or null
/// triangles  of the cloth, for air drag and contact
/// Throws InputError for a fabric whose shear the cells cannot carry.
ClothModel scene_model(const Scene& scene, const QuadMesh* mesh,
                       const std::vector<Triangle>& triangles);

/// The state at time 0: the rest shape with the initial velocity, or as the inline particles say.
State scene_state(const Scene& scene, const QuadMesh* mesh);

/// What scene_model built, and what it left out because the scene does not ask for it.
struct BuildReport {
  std::vector<std::string> built;
  std::vector<std::string> left_out;
};

BuildReport build_report(const ClothModel& model);

}  // namespace pleat
