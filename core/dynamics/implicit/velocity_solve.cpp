#include "core/dynamics/implicit/velocity_solve.h"

#include <utility>

#include "core/dynamics/implicit/best_translation.h"
#include "core/linalg/make_linear_solver.h"

namespace pleat {
namespace {

/// Share of a lower degree's squared error below which a degree is taken: it multiplies what
/// solves left over, up to eight times.
constexpr double kMuchLess = 0.5;
/// Substeps that the factor solves before the iterative solver is tried again: what made it give up
/// may be gone then, and its way to its cap costs as much as many factors.
constexpr int kTurnsOfFactor = 15;

}  // namespace

VelocitySolve::VelocitySolve(const ClothModel& model, SolverKind kind,
                             std::unique_ptr<LinearSolver> solver)
    : model_(model), kind_(kind), solver_(std::move(solver)) {
  const Positions none = Positions::Zero(3, model.n_vertices());
  change_ = none;
  difference_ = none;
  differences_.fill(none);
}

void VelocitySolve::analyze(const SystemMatrix& matrix) {
  solver_->analyze(matrix.lower());
  factor_.reset();
  n_in_its_place_ = 0;
}

void VelocitySolve::choose_pins(SystemMatrix& matrix) {
  std::vector<VertexId> vertices;
  for (const Pin& pin : model_.pins) vertices.push_back(pin.vertex);
  matrix.choose_prescribed(vertices);
  pin_changes_.resize(3, static_cast<Eigen::Index>(vertices.size()));
  is_free_.assign(static_cast<std::size_t>(model_.n_vertices()), char{1});
  for (const VertexId vertex : vertices) is_free_[vertex] = 0;
  for (const HangingVertex& hanging : model_.hanging) is_free_[hanging.vertex] = 0;
}

void VelocitySolve::keep_momentum(const SystemMatrix& matrix, const Positions& rhs) {
  const Vec3 translation = best_translation(matrix.lower(), rhs, change_, is_free_);
  for (int i = 0; i < model_.n_vertices(); ++i)
    if (is_free_[i] != 0) change_.col(i) += translation;
}

void VelocitySolve::guess() {
  change_ = differences_[0];
  for (std::size_t k = 1; k <= degree_; ++k) change_ += differences_[k];
}

// The polynomial of degree k was wrong by the difference k + 1.
void VelocitySolve::learn() {
  double least = 0;
  difference_ = change_;
  for (std::size_t k = 0; k < differences_.size(); ++k) {
    differences_[k].swap(difference_);
    difference_ = differences_[k] - difference_;
    const double error = difference_.squaredNorm();
    if (k > 0 && !(error < kMuchLess * least)) continue;
    degree_ = k;
    least = error;
  }
}

SolveReport VelocitySolve::solve_as_asked(const SystemMatrix& matrix, const Positions& rhs,
                                          const State& state, PartObserver* observer) {
  {
    const PartScope scope(observer, Part::factor);
    solver_->set_places(flat(state.positions));
    SolveReport report = solver_->factorize(matrix.lower());
    if (!report.ok()) return report;
  }
  const PartScope scope(observer, Part::solve);
  SolveReport report = solver_->solve(flat(rhs), flat(change_));
  if (!is_direct(kind_)) keep_momentum(matrix, rhs);
  return report;
}

SolveReport VelocitySolve::solve_in_its_place(const SystemMatrix& matrix, const Positions& rhs,
                                              PartObserver* observer) {
  SolveReport report;
  {
    const PartScope scope(observer, Part::factor);
    if (!factor_) {
      factor_ = make_linear_solver(SolverKind::supernodal);
      factor_->analyze(matrix.lower());
    }
    report = factor_->factorize(matrix.lower());
  }
  if (!report.ok()) return report;
  const PartScope scope(observer, Part::solve);
  report = factor_->solve(flat(rhs), flat(change_));
  report.message = "the solver gave up, and a factor solved in its place";
  return report;
}

// Keeps what the iterative solver came to where the factor fails too.
SolveReport VelocitySolve::solve(const SystemMatrix& matrix, const Positions& rhs,
                                 const State& state, PartObserver* observer) {
  if (n_in_its_place_ > 0) {
    --n_in_its_place_;
    SolveReport report = solve_in_its_place(matrix, rhs, observer);
    if (report.ok()) return report;
  }
  SolveReport asked = solve_as_asked(matrix, rhs, state, observer);
  if (asked.ok() || is_direct(kind_)) return asked;
  SolveReport report = solve_in_its_place(matrix, rhs, observer);
  if (!report.ok()) return asked;
  n_in_its_place_ = kTurnsOfFactor;
  report.iterations += asked.iterations;
  return report;
}

SolveReport VelocitySolve::find_changes(SystemMatrix& matrix, Positions& rhs, const State& state,
                                        double time_end, double h, PartObserver* observer) {
  for (std::size_t p = 0; p < model_.pins.size(); ++p) {
    const Pin& pin = model_.pins[p];
    pin_changes_.col(static_cast<Eigen::Index>(p)) =
        (pin.position(time_end) - state.positions.col(pin.vertex)) / h -
        state.velocities.col(pin.vertex);
  }
  matrix.prescribe(pin_changes_, flat(rhs));
  guess();
  return find_changes_again(matrix, rhs, state, h, observer);
}

SolveReport VelocitySolve::find_changes_again(const SystemMatrix& matrix, const Positions& rhs,
                                              const State& state, double h,
                                              PartObserver* observer) {
  const double asked = rhs.norm();
  SolveReport report = solve(matrix, rhs, state, observer);
  const double weight = h * model_.gravity.norm() * model_.masses.norm();
  if (asked < weight) report.relative_residual *= asked / weight;
  return report;
}

void VelocitySolve::move(State& state, double time_end, double h) {
  learn();
  state.velocities += change_;
  state.positions += h * state.velocities;
  for (const Pin& pin : model_.pins) state.positions.col(pin.vertex) = pin.position(time_end);
}

SolveReport VelocitySolve::advance(SystemMatrix& matrix, Positions& rhs, State& state,
                                   double time_end, double h, PartObserver* observer) {
  SolveReport report = find_changes(matrix, rhs, state, time_end, h, observer);
  if (!report.ends_run()) move(state, time_end, h);
  return report;
}

}  // namespace pleat
