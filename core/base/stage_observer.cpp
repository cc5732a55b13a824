#include "core/base/stage_observer.h"

namespace pleat {

const char* name(Stage stage) {
  switch (stage) {
    case Stage::convert:
      return "convert";
    case Stage::forces:
      return "forces";
    case Stage::assembly:
      return "assembly";
    case Stage::factor:
      return "factor";
    case Stage::solve:
      return "solve";
    case Stage::contact:
      return "contact";
    case Stage::strain_limit:
      return "strain limit";
  }
  return "";
}

}  // namespace pleat
