#include "core/fabric/taut_springs.h"

#include "core/base/check.h"

namespace pleat {

std::vector<Spring> taut_springs(const std::vector<Spring>& springs, double stiffening_strain) {
  PLEAT_CHECK(stiffening_strain > 0, "a stiffening strain is positive");
  std::vector<Spring> taut;
  for (const Spring& spring : springs) {
    if (spring.kind != SpringKind::warp && spring.kind != SpringKind::weft) continue;
    taut.push_back({spring.a, spring.b, (kTautFactor - 1) * spring.stiffness,
                    (1 + stiffening_strain) * spring.rest_length, 0, spring.kind});
  }
  return taut;
}

}  // namespace pleat
