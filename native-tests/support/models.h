#pragma once

#include <string>
#include <vector>

#include "core/dynamics/stepper.h"
#include "core/linalg/sparse.h"
#include "core/model/cloth_model.h"
#include "core/model/state.h"
#include "core/scene/scene.h"
#include "native-tests/support/meshes.h"

namespace pleat {

/// The measured fabrics, with the rigidity of moving cloth.
std::vector<FabricConstants> library_fabrics();
FabricConstants library_fabric(const std::string& name);

/// A soft fabric whose motion is smooth at steps of a few milliseconds.
FabricConstants soft_fabric();

/// Springs and bending of a sheet; no pins, no gravity, no air.
ClothModel sheet_model(const QuadMesh& mesh, const FabricConstants& fabric);

/// Sheet as a membrane with fitted bending; no pins, no gravity, no air.
ClothModel membrane_model(const QuadMesh& mesh, const FabricConstants& fabric);

/// A sheet on which every kind of element acts at once.
ClothModel model_of_everything(const QuadMesh& mesh, const FabricConstants& fabric);

/// The state at rest in the rest shape.
State rest_state(const QuadMesh& mesh);

/// A chain of equal springs that hangs from a pin at the origin. Vertex 0 is the pin.
struct Chain {
  int n_springs = 8;
  double stiffness = 500;  ///< stiffness of each spring [N/m]
  double length = 0.1;     ///< rest length of each spring [m]
  double mass = 0.02;      ///< mass of each node [kg]; the last has half of it
  double gravity = 9.81;   ///< downward [m/s^2]
  double relaxation = 0;   ///< damping c = relaxation * stiffness [s]
};

ClothModel chain_model(const Chain& chain);

/// The state at rest where weight and springs balance: spring i carries everything below it.
State hanging_state(const Chain& chain);

/// The whole of a symmetric matrix held by its lower triangle.
Eigen::MatrixXd dense(const SparseMatrix& lower);

/// C = -d(damping force)/dv, lower triangle, 3n x 3n [N s/m].
SparseMatrix damping_matrix(const ClothModel& model, const Eigen::Ref<const Positions>& positions);

/// Every stepper with settings that solve its own equations as exactly as it can: steps of `step`
/// [s], one substep, many rounds.
std::vector<MethodOptions> converged_methods(double step);

/// Every stepper with the settings that people use: a step of 1/60 s.
std::vector<MethodOptions> everyday_methods();

/// The exact and the explicit method of higher order, with steps of `step` [s].
std::vector<MethodOptions> accurate_methods(double step);

/// A sheet of 1 m x 1 m with `cells` x `cells` cells of a library fabric, held by its upper edge,
/// horizontal at first.
Scene released_sheet_scene(int cells, const std::string& fabric);

}  // namespace pleat
