#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/fabric/fabric.h"

namespace pleat {

struct FabricLibrary {
  std::vector<Fabric> fabrics;
  std::map<std::string, std::string> sources;  ///< key to citation

  /// Either name finds a fabric that has a second one in brackets. Throws InputError at
  /// /fabric/name listing the known names when there is none of that name.
  const Fabric& find(std::string_view name) const;
};

/// The shear stiffness [N/m] that a fabric has to stay below so that its membrane stiffness
/// [[K_u, G], [G, K_v]] resists every stretch: the geometric mean of the stretch stiffnesses [N/m].
double shear_bound(double stretch_warp, double stretch_weft);

/// Reads assets/fabrics/fabrics.json. Throws InputError with the JSON pointer for anything missing,
/// of the wrong type, outside its own range or not physical.
FabricLibrary read_fabrics(std::string_view json_text);

}  // namespace pleat
