#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/dynamics/stepper.h"
#include "core/fabric/fabric.h"
#include "core/files/frame_format.h"
#include "core/model/cloth_model.h"
#include "core/refinement/refinement_plan.h"
#include "core/scene/scene_body.h"
#include "core/scene/sheet_cloth.h"
#include "core/scene/surface_solid.h"

namespace pleat {

/// A box along the axes, sides included.
struct PinBox {
  Vec3 low{0, 0, 0};   ///< [m]
  Vec3 high{0, 0, 0};  ///< [m], nowhere below `low`

  bool holds(const Vec3& x) const {
    return (low.array() <= x.array() && x.array() <= high.array()).all();
  }
};

/// Pins, at every refinement, the part of the cloth of that name or what rests in a box; or only
/// listed vertices (of the unrefined cloth).
struct PinRule {
  std::variant<std::string, std::vector<VertexId>, PinBox> where;
  Motion motion;                            ///< not `follow`
  std::optional<Bone> bone = std::nullopt;  ///< bone of the body that it follows instead
};

/// The law that holds a cloth together in its own plane.
enum class Elasticity {
  springs,   ///< springs on threads and diagonals of quads (docs/methods/springs.md)
  membrane,  ///< orthotropic triangles (docs/methods/membrane.md)
};

enum class BendingModel {
  none,
  quadratic,  ///< bending of mesh lines, with springs
  linear,     ///< bending of mesh lines by their chords, exact at one curvature
  fitted,     ///< bending of triangles, with a membrane (docs/methods/fitted_bending.md)
  hinge,      ///< hinges at edges, with a membrane: for comparison
};

struct Tearing;

struct ModelOptions {
  Elasticity elasticity = Elasticity::springs;
  BendingModel bending = BendingModel::quadratic;
  DampingDirection damping_direction = DampingDirection::along_spring;  ///< damping of springs
  bool shear = true;              ///< springs on both diagonals of each quad
  double stiffening_strain = 0;   ///< threads beyond it are kTautFactor times as stiff; 0: never
  double torsion = 0.4;           ///< fitted: twisting rigidity in shares of sqrt(B_warp B_weft)
  double stiffness_exponent = 0;  ///< springs of faces of level l are 2^(this l) times as stiff
  std::optional<StrainLimitOptions> strain_limit;
  std::shared_ptr<const Tearing> tearing;  ///< or null: the cloth holds whatever pulls at it
};

/// Contact of a cloth with itself; what is not set is the fabric's.
struct SelfContactOptions {
  std::optional<double> friction;   ///< Coulomb coefficient, not below 0
  std::optional<double> thickness;  ///< gap that layers rest at [m], positive
};

struct RecordOptions {
  double every = 1.0 / 60;  ///< [s], positive, rounded to whole steps
  FrameFormat format = FrameFormat::obj;
};

/// State in which cloth, refined uniformly, begins in place of its rest shape.
struct StartState {
  Positions positions;   ///< [m]
  Positions velocities;  ///< one per vertex [m/s]
  int level = 0;         ///< uniform refinements
};

/// A scene as its file describes it. Every default of the format stands here and in the option
/// structs it holds, and nowhere else.
struct Scene {
  std::string name = "unnamed";
  std::string caption;  ///< one sentence: what to notice
  SceneCloth cloth = SheetCloth{};
  BendSource bend_source = BendSource::at_rest;
  bool fabric_is_named =
      false;  ///< then fabric.name is a library fabric, else the numbers are the scene's own
  FabricConstants fabric;
  std::vector<std::string>
      fabric_overrides;  ///< keys of the numbers a scene sets beside a named fabric's
  ModelOptions model;
  int level = 0;                       ///< uniform refinements, 0 to kMaxLevel; with a plan 0
  std::optional<RefinementPlan> plan;  ///< refinement of cloth that is made of quads
  std::optional<StartState> start;
  std::shared_ptr<const SceneBody> body;  ///< or null
  std::vector<PinRule> pins;
  Vec3 gravity{0, -9.81, 0};  ///< [m/s^2]
  std::optional<AirOptions> air;
  std::vector<Collider> colliders;
  std::vector<SurfaceSolid> surface_solids;  ///< colliders that are met by their surfaces
  ContactResponse contact_response = ContactResponse::resting;  ///< response of colliders and body
  /// Contact of the cloth with itself; without it, it passes through.
  std::optional<SelfContactOptions> self_contact;
  MethodOptions method;
  double duration = 5;  ///< [s], positive
  RecordOptions record;
};

}  // namespace pleat
