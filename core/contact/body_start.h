#pragma once

#include <string>

#include "core/contact/self_contact.h"

namespace pleat {

/// Says where cloth is that cannot be kept out of bodies, as it begins inside of one, passes
/// through its surface or lies on it; empty for none.
///
/// positions  of the cloth [m]
/// time       of the bodies' motions [s]
std::string cloth_in_bodies(const SelfContact& surfaces, const PositionsView& positions,
                            double time);

}  // namespace pleat
