#include "core/fabric/fabric.h"

namespace pleat {
namespace {

/// Friction holds M between B kappa - 2HB/2 and B kappa + 2HB/2 inside the moment loop. A purely
/// elastic sheet that shall carry the upper branch M = B kappa + 2HB/2 at kappa0 needs the slope B
/// + (2HB/2)/kappa0.
double static_rigidity(double bend, double hysteresis) {
  return bend + hysteresis / 2 / kStaticBendCurvature;
}

}  // namespace

FabricConstants constants(const Fabric& fabric, BendSource bend_source) {
  FabricConstants numbers;
  numbers.name = fabric.name;
  numbers.areal_density = fabric.areal_density.value;
  numbers.thickness = fabric.thickness.value;
  numbers.stretch_warp = fabric.stretch_warp.value;
  numbers.stretch_weft = fabric.stretch_weft.value;
  numbers.shear = fabric.shear.value;
  numbers.bend_warp = fabric.bend_warp.value;
  numbers.bend_weft = fabric.bend_weft.value;
  numbers.damping_ratio = fabric.damping_ratio.value;
  numbers.friction_solid = fabric.friction_solid.value;
  numbers.friction_fabric = fabric.friction_fabric.value;
  if (bend_source == BendSource::friction) numbers.bend_hysteresis = fabric.bend_hysteresis.value;
  if (bend_source == BendSource::at_rest) {
    numbers.bend_warp = static_rigidity(numbers.bend_warp, fabric.bend_hysteresis.value);
    numbers.bend_weft = static_rigidity(numbers.bend_weft, fabric.bend_hysteresis.value);
  }
  return numbers;
}

}  // namespace pleat
