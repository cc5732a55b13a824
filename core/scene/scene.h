#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/dynamics/stepper.h"
#include "core/fabric/fabric.h"
#include "core/figure/garment_patterns.h"
#include "core/figure/mannequin.h"
#include "core/files/frame_format.h"
#include "core/mesh/quad_mesh.h"
#include "core/mesh/triangle_mesh.h"
#include "core/mesh/vertex_group.h"
#include "core/model/cloth_model.h"
#include "core/refinement/refinement_plan.h"

namespace pleat {

/// Particles and springs written out in the scene: textbook systems (pendulum, chain) are scenes
/// too.
struct InlineCloth {
  Positions positions;     ///< at time 0 [m]
  Positions velocities;    ///< at time 0 [m/s], same size
  Eigen::VectorXd masses;  ///< [kg], positive
  std::vector<Spring> springs;
  std::vector<BendElement> bends;
  std::vector<Triangle> triangles;  ///< for drawing and air drag; may be empty
};

/// Any triangle mesh, at rest at time 0.
struct MeshCloth {
  TriangleMesh mesh;                    ///< sound (mesh_fault), with all warp directions
  std::vector<VertexGroup> groups;      ///< with different names, none empty
  RestCoordinates texture_coordinates;  ///< 2 x n; empty unless each vertex has exactly one pair
  std::vector<std::optional<CornerTexture>> textures;  ///< of each triangle
};

/// A body in the scene: a solid, and bones that pins may follow. It stands at time 0.
struct Figure {
  BodyBuild build = BodyBuild::average;
  BodyMotion motion;
  Playback playback;
  std::optional<double> friction;  ///< else the fabric's
};

/// Quads around the standing figure.
struct GarmentCloth {
  std::variant<SkirtMeasures, TrouserMeasures> measures;
  Garment garment;  ///< made from them
};

/// Named parts of a sheet. Upper is u = 0 (where warp begins), left is v = 0 (where weft begins).
enum class SheetPart {
  upper_edge,
  lower_edge,
  left_edge,
  right_edge,
  upper_left,
  upper_right,
  lower_left,
  lower_right
};

/// A box along the axes, sides included.
struct PinBox {
  Vec3 low{0, 0, 0};   ///< [m]
  Vec3 high{0, 0, 0};  ///< [m], nowhere below `low`

  bool holds(const Vec3& x) const {
    return (low.array() <= x.array() && x.array() <= high.array()).all();
  }
};

/// Pins, at every refinement, a part of a sheet, a mesh's group of that name or what rests in a
/// box; or only listed vertices (of the base mesh, or inline particles).
struct PinRule {
  std::variant<SheetPart, std::vector<VertexId>, std::string, PinBox> where;
  Motion motion;                            ///< not `follow`
  std::optional<Bone> bone = std::nullopt;  ///< of the figure, which it follows instead
};

/// What holds a cloth together in its own plane.
enum class Elasticity {
  springs,   ///< along the threads and on the diagonals of quads (docs/methods/springs.md)
  membrane,  ///< orthotropic triangles (docs/methods/membrane.md)
};

enum class BendingModel {
  none,
  quadratic,  ///< of mesh lines, with springs
  arc,        ///< of mesh lines, by their chords
  linear,     ///< of mesh lines, exact at one curvature
  fitted,     ///< of triangles, with a membrane (docs/methods/fitted_bending.md)
  hinge,      ///< of edges, with a membrane: for comparison
};

struct ModelOptions {
  Elasticity elasticity = Elasticity::springs;
  BendingModel bending = BendingModel::quadratic;
  DampingDirection damping_direction = DampingDirection::along_spring;  ///< of springs
  bool shear = true;  ///< springs on both diagonals of each quad
  double stiffening_strain =
      0;               ///< along the threads; beyond it kTautFactor times as stiff; 0: never
  double torsion = 1;  ///< fitted: twisting rigidity in shares of sqrt(B_warp B_weft)
  double stiffness_exponent = 0;  ///< springs of faces of level l are 2^(this l) times as stiff
};

struct RecordOptions {
  double every = 1.0 / 60;  ///< [s], positive, rounded to whole steps
  FrameFormat format = FrameFormat::obj;
};

/// A scene as its file describes it. Every default of the format stands here and in the option
/// structs it holds, and nowhere else.
struct Scene {
  std::string name = "unnamed";
  std::string caption;  ///< one sentence: what to notice
  std::variant<SheetShape, InlineCloth, MeshCloth, GarmentCloth> cloth = SheetShape{};
  Vec3 initial_velocity{0, 0, 0};  ///< of a sheet or mesh [m/s]
  BendSource bend_source = BendSource::at_rest;
  bool fabric_is_named =
      false;  ///< then fabric.name is a library fabric, else the numbers are the scene's own
  FabricConstants fabric;
  std::vector<std::string>
      fabric_overrides;  ///< keys of the numbers a scene sets beside a named fabric's
  ModelOptions model;
  int level = 0;                       ///< uniform refinements, 0 to kMaxLevel; with a plan 0
  std::optional<RefinementPlan> plan;  ///< of a sheet or garment, where to refine
  std::optional<Figure> figure;
  std::vector<PinRule> pins;
  Vec3 gravity{0, -9.81, 0};  ///< [m/s^2]
  std::optional<AirOptions> air;
  std::vector<Collider> colliders;
  MethodOptions method;
  double duration = 5;  ///< [s], positive
  RecordOptions record;
};

}  // namespace pleat
