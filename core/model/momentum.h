#pragma once

#include "core/model/cloth_model.h"
#include "core/model/state.h"

namespace pleat {

/// Linear momentum [kg m/s].
Vec3 momentum(const ClothModel& model, const State& state);

/// Angular momentum about the centre of mass [kg m^2/s].
Vec3 angular_momentum(const ClothModel& model, const State& state);

}  // namespace pleat
