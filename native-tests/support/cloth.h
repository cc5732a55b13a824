#pragma once

#include <utility>

#include "core/scene/scene.h"

namespace pleat {

/// Changes a scene's cloth, which is of this kind.
template <class Kind, class Change>
void change_cloth(Scene& scene, Change&& change) {
  Kind cloth = *scene.cloth.as<Kind>();
  change(cloth);
  scene.cloth = std::move(cloth);
}

}  // namespace pleat
