#pragma once

#include <variant>

#include "core/contact/swept_cone.h"
#include "core/contact/swept_contact.h"

namespace pleat {

/// The solids that there are. A new one has the functions of core/base/shapes.h and of
/// swept_contact.h, a form in core/scene/format/solid_section.cpp and one on the page; nothing else
/// asks which one it is, but to be faster than it can be for all.
using SolidShape = std::variant<Plane, Sphere, RoundedCone>;

}  // namespace pleat
