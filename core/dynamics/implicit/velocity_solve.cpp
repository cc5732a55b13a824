#include "core/dynamics/implicit/velocity_solve.h"

#include <utility>

#include "core/dynamics/implicit/best_translation.h"

namespace pleat {
namespace {

/// Share of a lower degree's squared error below which a degree is taken: it multiplies what
/// solves left over, up to eight times.
constexpr double kMuchLess = 0.5;

}  // namespace

VelocitySolve::VelocitySolve(const ClothModel& model, SolverKind kind,
                             std::unique_ptr<LinearSolver> solver)
    : model_(model), kind_(kind), solver_(std::move(solver)) {
  const Positions none = Positions::Zero(3, model.n_vertices());
  change_ = none;
  difference_ = none;
  differences_.fill(none);
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

SolveReport VelocitySolve::advance(SystemMatrix& matrix, Positions& rhs, State& state,
                                   double time_end, double h, PartObserver* observer) {
  for (std::size_t p = 0; p < model_.pins.size(); ++p) {
    const Pin& pin = model_.pins[p];
    pin_changes_.col(static_cast<Eigen::Index>(p)) =
        (pin.position(time_end) - state.positions.col(pin.vertex)) / h -
        state.velocities.col(pin.vertex);
  }
  matrix.prescribe(pin_changes_, flat(rhs));
  SolveReport report;
  {
    const PartScope scope(observer, Part::factor);
    solver_->set_places(flat(state.positions));
    report = solver_->factorize(matrix.lower());
  }
  if (!report.ok()) return report;
  {
    const PartScope scope(observer, Part::solve);
    guess();
    report = solver_->solve(flat(rhs), flat(change_));
    if (!is_direct(kind_)) keep_momentum(matrix, rhs);
    learn();
  }
  if (report.ends_run()) return report;
  state.velocities += change_;
  state.positions += h * state.velocities;
  for (const Pin& pin : model_.pins) state.positions.col(pin.vertex) = pin.position(time_end);
  return report;
}

}  // namespace pleat
