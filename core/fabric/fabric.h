#pragma once

#include <string>
#include <vector>

#include "core/fabric/deform_weights.h"

namespace pleat {

enum class Confidence {
  measured,   ///< taken from, or bracketed by, measured specimens of the category
  typical,    ///< lies inside ranges reported for the category
  estimated,  ///< inferred; read as plus or minus a factor of two
};

/// A number with its provenance, in the SI unit of the field that holds it.
struct SourcedValue {
  double value = 0;
  double low = 0;  ///< plausible range
  double high = 0;
  Confidence confidence = Confidence::estimated;
  std::vector<std::string> sources;  ///< keys into FabricLibrary::sources
};

/// One number for each way in which a fabric is measured by its shape: a ratio of lengths or areas,
/// or what such ratios are normalised to.
struct GeometricMeasures {
  double recovery = 0;  ///< measured by the projected area after crumpling
  double stretch = 0;   ///< measured by the length of the diagonal when pulled
  double bending = 0;   ///< measured by the height of wrinkles
};

/// One measured fabric. Definitions and conversions: assets/SOURCES.md.
struct Fabric {
  int id = 0;
  std::string name;
  std::string construction;        ///< the cloth that the numbers assume
  std::string colour;              ///< name in the source
  std::string use;                 ///< clothes made of it, in the source
  SourcedValue areal_density;      ///< [kg/m^2]
  SourcedValue thickness;          ///< [m]
  SourcedValue stretch_warp;       ///< secant membrane stiffness near 100 N/m [N/m]
  SourcedValue stretch_weft;       ///< [N/m]
  SourcedValue shear;              ///< shear stiffness per radian of shear angle [N/m]
  SourcedValue bend_warp;          ///< slope of moment over curvature, per width [N m]
  SourcedValue bend_weft;          ///< [N m]
  SourcedValue bend_hysteresis;    ///< width of the moment loop, 2HB [N]
  SourcedValue damping_ratio;      ///< share of critical damping
  SourcedValue friction_fabric;    ///< Coulomb, fabric on fabric
  SourcedValue friction_solid;     ///< Coulomb, fabric on a smooth dry solid
  SourcedValue drape_coefficient;  ///< Cusick, 30 / 18 cm [%]

  GeometricMeasures measured;       ///< v, each positive
  GeometricMeasures normalised;     ///< v', each within [0, 1], not all zero
  DeformWeights published_weights;  ///< uncorrected print (docs/methods/fabric_weights.md)
};

/// Bending rigidity that an elastic model gets.
enum class BendSource {
  at_rest,   ///< B + (2HB/2)/kappa0: friction inside the fabric holds a draped shape
  moving,    ///< the measured slope B alone
  friction,  ///< measured slope, with the friction itself beside it
};

/// The plain numbers that a simulation needs.
struct FabricConstants {
  std::string name = "custom";
  double areal_density = 0.1;    ///< [kg/m^2], positive
  double thickness = 0;          ///< [m], not negative
  double stretch_warp = 1000;    ///< K_u [N/m], positive
  double stretch_weft = 1000;    ///< K_v [N/m], positive
  double shear = 10;             ///< G [N/m], not negative
  double bend_warp = 0;          ///< B along warp [N m], not negative
  double bend_weft = 0;          ///< B along weft [N m], not negative
  double damping_ratio = 0;      ///< zeta, not negative
  double friction_solid = 0.3;   ///< not negative
  double friction_fabric = 0.4;  ///< not negative
  double bend_hysteresis = 0;    ///< 2HB of friction beside the rigidities [N], not negative
};

/// kappa0 at which half the hysteresis is turned into rigidity [1/m] (assets/SOURCES.md, static
/// bending).
constexpr double kStaticBendCurvature = 30;

FabricConstants constants(const Fabric& fabric, BendSource bend_source);

}  // namespace pleat
