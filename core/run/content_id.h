#pragma once

#include <string>
#include <string_view>

#include "core/scene/scene.h"

namespace pleat {

/// Sixteen hexadecimal digits of 64-bit FNV-1a.
std::string content_hash(std::string_view bytes);

/// The scene without what moves no vertex; a library's fabric as its numbers, which may change.
Scene moving_part(Scene scene);

/// Names what a reference is of: cloth, fabric, model, pins and world, whatever the level, the
/// method and how long it runs. The core's version is no part of it, so that references can be
/// shipped (kPhysicsVersion).
std::string content_id(const Scene& scene);

}  // namespace pleat
