#include "core/contact/collider.h"

#include <cmath>

#include "core/base/check.h"

namespace pleat {

void Collider::validate() const {
  PLEAT_CHECK(friction >= 0 && std::isfinite(friction),
              "a collider's friction must not be negative");
  std::visit([](const auto& solid) { pleat::validate(solid); }, shape);
}

}  // namespace pleat
