#include "core/base/part_observer.h"

namespace pleat {

const char* name(Part part) {
  switch (part) {
    case Part::convert:
      return "convert";
    case Part::forces:
      return "forces";
    case Part::assembly:
      return "assembly";
    case Part::factor:
      return "factor";
    case Part::solve:
      return "solve";
    case Part::contact:
      return "contact";
    case Part::strain_limit:
      return "strain limit";
  }
  return "";
}

}  // namespace pleat
