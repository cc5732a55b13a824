#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/dynamics/cloth_model.h"
#include "core/dynamics/stepper.h"
#include "core/fabric/fabric.h"
#include "core/mesh/quad_mesh.h"

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

/// Pins a named part of a sheet (at every refinement), or listed vertices (of the base mesh, or
/// inline particles).
struct PinRule {
  std::variant<SheetPart, std::vector<VertexId>> where;
  Motion motion;
};

enum class BendingModel { none, quadratic };

struct SpringModel {
  BendingModel bending = BendingModel::quadratic;
  DampingDirection damping_direction = DampingDirection::along_spring;
  bool shear = true;  ///< springs on both diagonals of each quad
};

enum class FrameFormat { none, obj, ply, binary };

struct RecordOptions {
  double every = 1.0 / 60;  ///< [s], positive, rounded to whole steps
  FrameFormat format = FrameFormat::obj;
};

/// A scene as its file describes it. Every default of the format stands here and in the option
/// structs it holds, and nowhere else.
struct Scene {
  std::string name = "unnamed";
  std::string caption;  ///< one sentence: what to notice
  std::variant<SheetShape, InlineCloth> cloth = SheetShape{};
  Vec3 initial_velocity{0, 0, 0};  ///< of a sheet [m/s]
  BendSource bend_source = BendSource::at_rest;
  bool fabric_is_named =
      false;  ///< then fabric.name is a library fabric, else the numbers are the scene's own
  FabricConstants fabric;
  std::vector<std::string>
      fabric_overrides;  ///< keys of the numbers a scene sets beside a named fabric's
  SpringModel model;
  int level = 0;  ///< uniform refinements, 0 to kMaxLevel
  std::vector<PinRule> pins;
  Vec3 gravity{0, -9.81, 0};  ///< [m/s^2]
  std::optional<AirOptions> air;
  std::vector<Collider> colliders;
  MethodOptions method;
  double duration = 5;  ///< [s], positive
  RecordOptions record;
};

}  // namespace pleat
