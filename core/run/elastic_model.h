#pragma once

#include "core/scene/rest_cloth.h"

namespace pleat {

/// Gives a model its masses and what holds the cloth together: what scene.model names, and nothing
/// else.
///
/// cloth  of this scene
/// Throws InputError for a fabric whose shear the cells or the membrane cannot carry, and for one
/// with friction inside on anything but springs of quads with quadratic bending.
void add_elasticity(ClothModel& model, const Scene& scene, const RestCloth& cloth);

}  // namespace pleat
