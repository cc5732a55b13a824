#include "native-tests/support/models.h"

#include "core/fabric/taut_springs.h"
#include "core/model/system_matrix.h"
#include "core/run/elastic_model.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

MethodOptions method(const StepperType* stepper, double step) {
  MethodOptions options;
  options.stepper = stepper;
  options.step = step;
  options.solver = SolverKind::eigen;
  return options;
}

}  // namespace

std::vector<FabricConstants> library_fabrics() {
  std::vector<FabricConstants> fabrics;
  for (const Fabric& fabric : fabric_library().fabrics)
    fabrics.push_back(constants(fabric, BendSource::moving));
  return fabrics;
}

FabricConstants library_fabric(const std::string& name) {
  return constants(fabric_library().find(name), BendSource::moving);
}

FabricConstants soft_fabric() {
  FabricConstants fabric;
  fabric.name = "soft";
  fabric.areal_density = 0.2;
  fabric.stretch_warp = 60;
  fabric.stretch_weft = 45;
  fabric.shear = 8;
  fabric.bend_warp = 2e-3;
  fabric.bend_weft = 1e-3;
  fabric.damping_ratio = 0.05;
  return fabric;
}

ClothModel sheet_model(const QuadMesh& mesh, const FabricConstants& fabric) {
  SpringLattice lattice = spring_lattice(mesh, fabric);
  ClothModel model;
  model.masses = std::move(lattice.masses);
  model.hanging = mesh.hanging_vertices();
  model.springs = std::move(lattice.springs);
  model.bends = std::move(lattice.bends);
  model.gravity.setZero();
  model.rest_coordinates = mesh.rest_coordinates();
  return model;
}

ClothModel membrane_model(const QuadMesh& mesh, const FabricConstants& fabric) {
  Scene scene;
  scene.fabric = fabric;
  scene.model.elasticity = Elasticity::membrane;
  scene.model.bending = BendingModel::fitted;
  scene.gravity.setZero();
  RestCloth cloth;
  cloth.quads = mesh;
  cloth.mesh = mesh.triangle_mesh();
  ClothModel model;
  model.gravity.setZero();
  add_elasticity(model, scene, cloth);
  return model;
}

ClothModel model_of_everything(const QuadMesh& mesh, const FabricConstants& fabric) {
  ClothModel model = membrane_model(mesh, fabric);
  const ClothModel springs = sheet_model(mesh, fabric);
  model.springs = springs.springs;
  model.bends = springs.bends;
  model.taut_springs = taut_springs(model.springs, 0.02);
  model.membrane.law.stiffening_strain = 0.02;
  model.chord_bends = spring_lattice(mesh, fabric, BendingLaw::linear).chord_bends;
  model.hinges = hinges(mesh.triangle_mesh(), fabric.bend_warp);
  model.bend_friction.emplace(line_bends(mesh, 1), 1e-3, mesh.crossed_triangles(),
                              mesh.rest_positions());
  return model;
}

State rest_state(const QuadMesh& mesh) {
  return {mesh.rest_positions(), Positions::Zero(3, mesh.n_vertices())};
}

ClothModel chain_model(const Chain& chain) {
  ClothModel model;
  model.masses = Eigen::VectorXd::Constant(chain.n_springs + 1, chain.mass);
  model.masses[chain.n_springs] = chain.mass / 2;
  for (int i = 0; i < chain.n_springs; ++i)
    model.springs.push_back({VertexId(i), VertexId(i + 1), chain.stiffness, chain.length,
                             chain.relaxation * chain.stiffness, SpringKind::other});
  model.gravity = {0, -chain.gravity, 0};
  model.pins.push_back({VertexId(0), Vec3::Zero(), {}});
  return model;
}

State hanging_state(const Chain& chain) {
  const int n = chain.n_springs;
  State state{Positions::Zero(3, n + 1), Positions::Zero(3, n + 1)};
  for (int i = 0; i < n; ++i) {
    const double mass_below = chain.mass * (n - i - 0.5);
    const double length = chain.length + mass_below * chain.gravity / chain.stiffness;
    state.positions(1, i + 1) = state.positions(1, i) - length;
  }
  return state;
}

Eigen::MatrixXd dense(const SparseMatrix& lower) {
  return Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
}

SparseMatrix damping_matrix(const ClothModel& model, const Eigen::Ref<const Positions>& positions) {
  SystemMatrix matrix(model);
  matrix.add_elasticity(positions, 0, 1, ElementHessian::projected);
  return matrix.lower();
}

std::vector<MethodOptions> converged_methods(double step) {
  MethodOptions explicit_method = method(&steppers::kExplicitEuler, step);
  MethodOptions projective = method(&steppers::kProjective, step);
  projective.iterations = 300;
  MethodOptions accelerated = projective;
  accelerated.acceleration = Acceleration::anderson;
  MethodOptions xpbd = method(&steppers::kXpbd, step);
  xpbd.iterations = 100;
  MethodOptions pbd = method(&steppers::kPbd, step);
  pbd.iterations = 100;
  MethodOptions newton = method(&steppers::kNewton, step);
  newton.rule = NewtonRule::backward_euler;
  newton.tolerance = kNewtonTolerance;
  return {explicit_method, method(&steppers::kImplicitEuler, step), projective, xpbd, pbd, newton,
          accelerated};
}

std::vector<MethodOptions> everyday_methods() {
  MethodOptions explicit_method = method(&steppers::kExplicitEuler, 1.0 / 60);
  explicit_method.substeps = 0;
  MethodOptions implicit = method(&steppers::kImplicitEuler, 1.0 / 60);
  implicit.solver = SolverKind::cg;
  MethodOptions projective = method(&steppers::kProjective, 1.0 / 60);
  projective.iterations = 10;
  MethodOptions accelerated = projective;
  accelerated.acceleration = Acceleration::anderson;
  MethodOptions xpbd = method(&steppers::kXpbd, 1.0 / 60);
  xpbd.substeps = 30;
  MethodOptions imex = method(&steppers::kImex, 1.0 / 60);
  imex.solver = SolverKind::sor;
  imex.tolerance = 1e-4;
  imex.substeps = 4;
  MethodOptions pbd = method(&steppers::kPbd, 1.0 / 60);
  pbd.substeps = 4;
  pbd.iterations = 10;
  return {explicit_method, implicit, imex, projective, xpbd, pbd, accelerated};
}

std::vector<MethodOptions> accurate_methods(double step) {
  MethodOptions newton = method(&steppers::kNewton, step);
  newton.rule = NewtonRule::midpoint;
  newton.tolerance = kNewtonTolerance;
  MethodOptions rk4 = method(&steppers::kRk4, step);
  rk4.substeps = 0;
  return {newton, rk4};
}

Scene released_sheet_scene(int cells, const std::string& fabric) {
  SheetShape shape;
  shape.rows = cells;
  shape.columns = cells;
  shape.warp_direction = {0, 0, 1};
  Scene scene;
  scene.cloth = SheetCloth(shape);
  scene.fabric = library_fabric(fabric);
  scene.pins = {{"upper_edge", {}}};
  return scene;
}

}  // namespace pleat
