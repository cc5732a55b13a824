#include "core/dynamics/stepper_implicit.h"

#include "core/base/check.h"
#include "core/dynamics/elasticity.h"

namespace pleat {
namespace {

constexpr int kMaxIterations = 2000;  // of CG; reaching it is reported as not converged

Eigen::Map<Eigen::VectorXd> flat(Positions& columns) { return {columns.data(), columns.size()}; }

}  // namespace

StepperImplicit::StepperImplicit(ClothModel& model, const MethodOptions& options)
    : Stepper(model, options, options.substeps, ContactMemory::last_substep),
      matrix_(model),
      solver_(make_solver(options, 3, kMaxIterations)),
      forces_(3, model.n_vertices()),
      velocity_changes_(Positions::Zero(3, model.n_vertices())),
      positions_begin_(3, model.n_vertices()) {
  solver_->analyze(matrix_.lower());
  refresh();
}

void StepperImplicit::refresh() {
  std::vector<VertexId> vertices;
  for (const Pin& pin : model_.pins) vertices.push_back(pin.vertex);
  matrix_.choose_prescribed(vertices);
  pin_changes_.resize(3, static_cast<Eigen::Index>(vertices.size()));
}

/// Fills the matrix with M + h C + h^2 K and `forces_` with h (f - h K v).
void StepperImplicit::assemble(const State& state, double h) {
  const StageScope scope(observer_, Stage::assembly);
  const Positions& v = state.velocities;
  matrix_.set_zero();
  matrix_.add_masses(model_.masses, 1);
  for (std::size_t s = 0; s < model_.springs.size(); ++s) {
    const Spring& spring = model_.springs[s];
    const SpringAxis axis = spring_axis(spring, state.positions);
    const Mat3 damping = h * spring_damping(spring, axis, model_.damping_direction);
    const Mat3 stiffness = h * h * spring_stiffness(spring, axis, SpringHessian::projected);
    matrix_.add_spring(s, damping + stiffness);
    const Vec3 pull = h * spring.stiffness * (axis.length - spring.rest_length) * axis.direction;
    const Vec3 impulse = pull + (damping + stiffness) * (v.col(spring.a) - v.col(spring.b));
    forces_.col(spring.a) -= impulse;
    forces_.col(spring.b) += impulse;
  }
  for (std::size_t b = 0; b < model_.bends.size(); ++b) {
    const BendElement& bend = model_.bends[b];
    matrix_.add_bend(b, h * h);
    Vec3 curvature_end = Vec3::Zero();  // of x + h v
    for (int k = 0; k < 3; ++k)
      curvature_end +=
          bend.weights[k] * (state.positions.col(bend.vertices[k]) + h * v.col(bend.vertices[k]));
    for (int k = 0; k < 3; ++k)
      forces_.col(bend.vertices[k]) -= h * bend.stiffness * bend.weights[k] * curvature_end;
  }
}

SolveReport StepperImplicit::substep(State& state, double time_end, double h) {
  positions_begin_ = state.positions;
  set_external_forces(state, h, forces_);
  forces_ *= h;
  assemble(state, h);
  for (std::size_t p = 0; p < model_.pins.size(); ++p) {
    const Pin& pin = model_.pins[p];
    pin_changes_.col(static_cast<Eigen::Index>(p)) =
        (pin.position(time_end) - state.positions.col(pin.vertex)) / h -
        state.velocities.col(pin.vertex);
  }
  matrix_.prescribe(pin_changes_, flat(forces_));
  SolveReport report;
  {
    const StageScope scope(observer_, Stage::factor);
    report = solver_->factorize(matrix_.lower());
  }
  if (!report.ok()) return report;
  {
    const StageScope scope(observer_, Stage::solve);
    report = solver_->solve(flat(forces_), flat(velocity_changes_));
  }
  state.velocities += velocity_changes_;
  state.positions += h * state.velocities;
  for (const Pin& pin : model_.pins) state.positions.col(pin.vertex) = pin.position(time_end);
  resolve_contacts(positions_begin_, state, time_end, h);
  return report;
}

}  // namespace pleat
