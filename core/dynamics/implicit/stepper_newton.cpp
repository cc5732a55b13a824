#include "core/dynamics/implicit/stepper_newton.h"

#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "core/base/random.h"
#include "core/model/elasticity.h"
#include "core/model/hanging_vertices.h"

namespace pleat {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr int kMaxPushes = 8;        // pushes off saddles
constexpr int kMaxIterations = 200;  // limit for a substep in time; reaching it is reported
constexpr int kMaxEquilibriumIterations = 5000;
constexpr int kMaxHalvings = 40;              // halvings of a step along a direction
constexpr double kLargestShare = 1024;        // limit for a direction of the projected Hessian
constexpr double kSufficientDecrease = 1e-4;  // Armijo's condition
constexpr double kHiddenDecrease = 1e-9;      // share of the potential that rounding may hide
constexpr double kShiftFactor = 4;            // the shift follows the steps by this factor
constexpr double kHoldTolerance = 1e-6;       // tolerance of minima by which holds are judged
constexpr double kLinearTolerance = 1e-3;     // relative residual of the first linear solve
constexpr double kIterativeTolerance = 1e-6;  // relative residual with a solver that has no factor
constexpr int kMaxLinearIterations = 15;  // limit for a kept factor; more cost as much as a new one
constexpr double kSmallestShift = 1e-6;   // share of the first one; below, the true Hessian stands

double largest_norm(const Positions& columns) {
  return std::sqrt(columns.colwise().squaredNorm().maxCoeff());
}

double diagonal_norm(const SparseMatrix& lower) {
  double sum = 0;
  for (int column = 0; column < lower.outerSize(); ++column) {
    const double entry = lower.valuePtr()[lower.outerIndexPtr()[column]];
    sum += entry * entry;
  }
  return std::sqrt(sum);
}

}  // namespace

StepperNewton::StepperNewton(ClothModel& model, const MethodOptions& options)
    : Stepper(model, options, options.substeps, ContactForces::remembered), matrix_(model) {
  if (is_at_rest() && (model.contact || model.meets_bodies()))
    throw InputError("/method/rule",
                     "expected backward_euler or midpoint beside solids, got equilibrium");
  if (is_at_rest() && model.self_contact)
    throw InputError("/method/rule",
                     "expected backward_euler or midpoint with self-contact, got equilibrium");
  if (is_at_rest() && model.air && model.air->has_wind())
    throw InputError("/method/rule",
                     "expected backward_euler or midpoint in wind, got equilibrium");
  if (is_at_rest() && model.bend_friction)
    throw InputError("/method/rule",
                     "expected backward_euler or midpoint with friction inside the fabric, whose "
                     "rest depends on the way to it, got equilibrium");
  if (options.solver == SolverKind::sor)
    throw InputError("/method/solver", "expected cg or a direct solver for newton, got sor");
  if (is_at_rest() && options.solver == SolverKind::cg)
    throw InputError("/method/solver",
                     "expected a direct solver for the rule equilibrium, whose factor tells a rest "
                     "from a saddle, got cg");
  if (is_at_rest() && model.pins.empty() && !model.gravity.isZero(0))
    throw InputError("/pins", "expected something held, as weight alone has no rest, got nothing");
  if (options.rule == NewtonRule::backward_euler) {
    if (model_.contact) hold_.emplace(model_);
    if (cloth_contact_) pair_hold_.emplace(model_, *cloth_contact_);
  }
  MethodOptions linear = options;
  linear.tolerance = kIterativeTolerance;
  solver_ = make_solver(linear, kMaxSolverIterations);
  solver_->analyze(matrix_.lower());
  base_ = matrix_.lower();
  for (Positions* columns : {&loads_, &gradient_, &direction_, &trial_, &velocities_, &product_})
    columns->resize(3, model.n_vertices());
  for (Eigen::VectorXd* vector :
       {&change_, &right_side_, &residual_, &preconditioned_, &search_, &image_})
    vector->resize(3 * model.n_vertices());
  refresh();
}

void StepperNewton::refresh() {
  std::vector<VertexId> vertices;
  for (const Pin& pin : model_.pins) vertices.push_back(pin.vertex);
  matrix_.choose_prescribed(vertices);
  no_change_ = Positions::Zero(3, static_cast<Eigen::Index>(vertices.size()));
  has_factor_ = false;
}

void StepperNewton::set_up(const State& state, double h) {
  const PartScope scope(observer_, Part::assembly);
  extent_ = box_diagonal(positions_begin_);
  if (extent_ == 0) extent_ = 1;  // vertices in one place: per metre
  loads_.setZero();
  add_gravity(model_, loads_);
  if (!hold_ && contact_memory_.has_forces()) {
    contact_memory_.turn_forces(state, h);
    loads_ += contact_memory_.forces();
  }
  matrix_.set_zero();
  if (!is_at_rest()) {
    interval_ = options().rule == NewtonRule::midpoint ? h / 2 : h;
    const double rate = 1 / interval_;
    matrix_.add_masses(rate * rate);
    trial_ = positions_begin_;
    if (options().rule == NewtonRule::midpoint) trial_ += interval_ * state.velocities;
    matrix_.add_elasticity(trial_, 0, rate, ElementHessian::projected);
    loads_ += rate * state.velocities * model_.masses.asDiagonal();
  }
  base_.coeffs() = matrix_.lower().coeffs();
  if (hold_ || pair_hold_) hold(state, h);
}

void StepperNewton::hold(const State& state, double h) {
  const double mass_unit = interval_ * interval_;
  matrix_.add_elasticity(positions_begin_, 1, 0, ElementHessian::projected);
  if (hold_) {
    hold_->set_resistances(matrix_, mass_unit);
    hold_->choose(contact_memory_, state, h, &matrix_, mass_unit);
  }
  if (pair_hold_) pair_hold_->set_resistances(matrix_, mass_unit);
  matrix_.set_values(base_);
  if (hold_) add_holds(hold_->held(), 1);
  if (pair_hold_) add_pairs(pair_hold_->held(), 1);
  base_.coeffs() = matrix_.lower().coeffs();
}

void StepperNewton::choose_pairs(const State& state, double time_end, double h) {
  const PartScope scope(observer_, Part::cloth_contact);
  pair_hold_->choose(state, time_end, h);
  if (pair_hold_->fits(matrix_)) return;
  matrix_.join(pair_hold_->joins());
  solver_->analyze(matrix_.lower());
  base_ = matrix_.lower();
  refresh();
}

/// Adds what holds these vertices to the matrix and the loads, or with -1 takes it out.
void StepperNewton::add_holds(std::span<const ContactHold::Held> holds, double sign) {
  for (const ContactHold::Held& held : holds) {
    matrix_.add_diagonal(held.vertex, sign / (interval_ * interval_) * held.resistance);
    loads_.col(held.vertex) += sign * (held.resistance * held.velocity / interval_ + held.force);
  }
}

/// The counterpart of pairs, of which positions are unknown where a linearised step has velocities.
void StepperNewton::add_pairs(std::span<const PairHold::Held> pairs, double sign) {
  product_.setZero();
  const PairHold::Units units = {sign / (interval_ * interval_), sign / interval_};
  PairHold::add(pairs, product_, interval_, units, matrix_, loads_);
}

/// Lets those go that a solid or cloth would pull or rub too much; false where there are none.
bool StepperNewton::let_loose() {
  velocities_ = (positions_ - positions_begin_) / interval_;
  std::span<const ContactHold::Held> freed;
  std::span<const PairHold::Held> lost;
  if (hold_) freed = hold_->let_loose(contact_memory_, velocities_, interval_);
  if (pair_hold_) lost = pair_hold_->let_loose(velocities_, interval_);
  if (freed.empty() && lost.empty()) return false;
  matrix_.set_values(base_);
  add_holds(freed, -1);
  if (!lost.empty()) add_pairs(lost, -1);
  base_.coeffs() = matrix_.lower().coeffs();
  return true;
}

void StepperNewton::place_first_guess(const State& state, double time_end) {
  positions_ = positions_begin_;
  if (!is_at_rest()) positions_ += interval_ * state.velocities;
  for (const Pin& pin : model_.pins) {
    const Vec3 end = pin.position(time_end);
    positions_.col(pin.vertex) = options().rule == NewtonRule::midpoint
                                     ? Vec3((positions_begin_.col(pin.vertex) + end) / 2)
                                     : end;
  }
  place_between_parents(model_.hanging, positions_);
}

/// The function that a substep minimises, with drag expanded about the present iterate. `magnitude`
/// (may be null) gets the sum of the terms' sizes.
double StepperNewton::potential(const Positions& positions, double* magnitude) {
  change_ = flat(positions) - flat(positions_begin_);
  flat(product_).noalias() = base_.selfadjointView<Eigen::Lower>() * change_;
  const double kinetic = 0.5 * change_.dot(flat(product_));
  const double work = change_.dot(flat(loads_));
  const double elastic = elastic_energy(model_, positions);
  double drag = 0;
  if (model_.air && !is_at_rest()) {
    for (int i = 0; i < model_.n_vertices(); ++i) {
      const Vec3 step = positions.col(i) - positions_.col(i);
      const Mat3 resistance = model_.air->resistance(VertexId(i));
      drag += step.dot(resistance * step) / (2 * interval_) - step.dot(model_.air->forces().col(i));
    }
  }
  if (magnitude != nullptr) *magnitude = std::abs(kinetic) + std::abs(work) + std::abs(elastic);
  return kinetic - work + elastic + drag;
}

void StepperNewton::evaluate_gradient() {
  const PartScope scope(observer_, Part::forces);
  gradient_.setZero();
  add_elastic_forces(model_, positions_, gradient_);
  if (model_.air && !is_at_rest()) {
    velocities_ = (positions_ - positions_begin_) / interval_;
    model_.air->evaluate(positions_, velocities_);
    gradient_ += model_.air->forces();
  }
  pull_to_parents(model_.hanging, gradient_);
  residual_scale_ =
      std::max(loads_.norm() + gradient_.norm(), model_.gravity.norm() * model_.masses.norm());
  change_ = flat(positions_) - flat(positions_begin_);
  flat(product_).noalias() = base_.selfadjointView<Eigen::Lower>() * change_;
  pull_to_parents(model_.hanging, product_);
  gradient_ = product_ - loads_ - gradient_;
  for (const Pin& pin : model_.pins) gradient_.col(pin.vertex).setZero();
}

void StepperNewton::fill_matrix(ElementHessian hessian) {
  const PartScope scope(observer_, Part::assembly);
  matrix_.set_values(base_);
  matrix_.add_elasticity(positions_, 1, 0, hessian);
  if (model_.air && !is_at_rest())
    for (int i = 0; i < model_.n_vertices(); ++i)
      matrix_.add_diagonal(VertexId(i), model_.air->resistance(VertexId(i)) / interval_);
  if (shift_ > 0) matrix_.add_masses(shift_);
  // The change of the forces by rounding of places alone.
  rounding_ = kEpsilon * extent_ * diagonal_norm(matrix_.lower());
  right_side_ = -flat(gradient_);
  matrix_.reduce_to_parents(right_side_);
  matrix_.prescribe(no_change_, right_side_);
}

SolveReport StepperNewton::solve_with_new_factor() {
  {
    const PartScope scope(observer_, Part::factor);
    solver_->set_places(flat(positions_));
    SolveReport report = solver_->factorize(matrix_.lower());
    has_factor_ = report.ok() && is_direct(options().solver);
    if (!report.ok()) return report;
  }
  const PartScope scope(observer_, Part::solve);
  direction_.setZero();
  return solver_->solve(right_side_, flat(direction_));
}

/// Conjugate gradients on the matrix with the kept factor as preconditioner.
SolveReport StepperNewton::solve_with_kept_factor() {
  const PartScope scope(observer_, Part::solve);
  const auto A = matrix_.lower().selfadjointView<Eigen::Lower>();
  Eigen::Map<Eigen::VectorXd> x = flat(direction_);
  x.setZero();
  residual_ = right_side_;
  // Falls with what is left of the gradient, so that Newton's convergence stays quadratic.
  const double share_left = right_side_.norm() / first_gradient_norm_;
  const double enough = kLinearTolerance * std::min(1.0, share_left) * right_side_.norm();
  double product = 0;
  SolveReport report;
  for (report.iterations = 0; report.iterations < kMaxLinearIterations; ++report.iterations) {
    if (residual_.norm() <= enough) return report;
    solver_->solve(residual_, preconditioned_);
    const double last_product = product;
    product = residual_.dot(preconditioned_);
    if (report.iterations == 0)
      search_ = preconditioned_;
    else
      search_ = preconditioned_ + product / last_product * search_;
    image_.noalias() = A * search_;
    const double curvature = search_.dot(image_);
    if (curvature <= 0) {
      report.status = SolveStatus::not_positive_definite;
      return report;
    }
    x += product / curvature * search_;
    residual_ -= product / curvature * image_;
  }
  report.status = SolveStatus::not_converged;
  return report;
}

SolveReport StepperNewton::solve_linear_system() {
  if (has_factor_) {
    SolveReport report = solve_with_kept_factor();
    if (report.status != SolveStatus::not_converged) return report;
  }
  return solve_with_new_factor();
}

SolveReport StepperNewton::find_direction() {
  fill_matrix(ElementHessian::exact);
  SolveReport report = solve_linear_system();
  is_projected_ = report.status == SolveStatus::not_positive_definite;
  if (is_projected_) {
    fill_matrix(ElementHessian::projected);
    report = solve_linear_system();
  }
  while (is_at_rest() && report.status == SolveStatus::not_positive_definite &&
         shift_ < first_shift() / kEpsilon) {
    shift_ = std::max(first_shift(), kShiftFactor * shift_);
    fill_matrix(ElementHessian::projected);
    report = solve_linear_system();
  }
  place_between_parents(model_.hanging, direction_);
  return report;
}

/// True where the whole direction leaves half of the gradient at most.
bool StepperNewton::halves_gradient() {
  const double before = gradient_.norm();
  trial_ = positions_;
  positions_ += direction_;
  evaluate_gradient();
  const bool halves = gradient_.norm() <= before / 2;
  positions_ = trial_;
  evaluate_gradient();
  return halves;
}

/// The share of the direction after which the potential is lower; 0 when there is none.
double StepperNewton::search_line() {
  const PartScope scope(observer_, Part::solve);
  double magnitude = 0;
  const double before = potential(positions_, &magnitude);
  const double slope = gradient_.cwiseProduct(direction_).sum();
  const double noise = 64 * kEpsilon * magnitude;  // sums of many rounded terms
  const auto potential_at = [&](double share) {
    trial_ = positions_ + share * direction_;
    return potential(trial_, nullptr);
  };
  // Strains are differences of lengths: their rounding may hide what the gradient shows. Beside a
  // saddle, where the Hessian is projected, a smaller gradient is no sign of a minimum.
  if (!is_projected_ && -slope <= kHiddenDecrease * magnitude && halves_gradient()) return 1;
  double share = 1;
  for (int halving = 0; halving < kMaxHalvings; ++halving, share /= 2) {
    double reached = potential_at(share);
    if (reached > before + kSufficientDecrease * share * slope + noise) continue;
    // The projected Hessian is stiffer than the cloth where that buckles: go on while it pays.
    while (is_projected_ && share >= 1 && share < kLargestShare) {
      const double further = potential_at(2 * share);
      if (further >= reached) break;
      reached = further;
      share *= 2;
    }
    return share;
  }
  return 0;
}

/// True where the true Hessian is positive definite: not on a saddle, and not free to move.
bool StepperNewton::is_stable() {
  shift_ = 0;
  fill_matrix(ElementHessian::exact);
  const PartScope scope(observer_, Part::factor);
  has_factor_ = solver_->factorize(matrix_.lower()).ok();
  return has_factor_;
}

/// Pushes off a saddle, where cloth would stand on its edge for ever.
void StepperNewton::push_off(int attempt) {
  constexpr double kPush = 1e-6;  // share of the extent: far below what is seen, far above rounding
  Random random(static_cast<std::uint64_t>(attempt));
  for (double& coordinate : trial_.reshaped()) coordinate = random.uniform(-1, 1);
  for (const Pin& pin : model_.pins) trial_.col(pin.vertex).setZero();
  place_between_parents(model_.hanging, trial_);
  positions_ += kPush * extent_ * trial_;
  evaluate_gradient();
}

/// Finds by coarse minima which holds stay; the number of iterations.
int StepperNewton::find_holds() {
  int n_iterations = 0;
  const bool any = (hold_ && !hold_->held().empty()) || (pair_hold_ && !pair_hold_->held().empty());
  if (!any) return n_iterations;
  for (int n = 0; n < ContactHold::kMaxRepeats; ++n) {
    const SolveReport report = minimise(kHoldTolerance);
    n_iterations += report.iterations;
    if (!report.ok() || !let_loose()) break;
  }
  return n_iterations;
}

/// tolerance  of the last direction, as a share of the cloth's extent
SolveReport StepperNewton::minimise(double tolerance) {
  const int max_iterations = is_at_rest() ? kMaxEquilibriumIterations : kMaxIterations;
  shift_ = 0;
  int n_pushes = 0;
  SolveReport report;
  evaluate_gradient();
  first_gradient_norm_ = gradient_.norm();
  for (int iteration = 1; iteration <= max_iterations; ++iteration) {
    SolveReport solved = find_direction();
    if (!solved.ok()) return solved;
    report.iterations = iteration;
    const bool is_last = shift_ == 0 && largest_norm(direction_) <= tolerance * extent_;
    const double share = is_last ? 1 : search_line();
    positions_ += share * direction_;
    evaluate_gradient();
    const bool is_noise = gradient_.norm() <= rounding_;
    report.relative_residual = is_noise ? 0 : gradient_.norm() / residual_scale_;
    if (is_last || is_noise) {
      if (!is_at_rest() || n_pushes == kMaxPushes || is_stable()) return report;
      push_off(n_pushes++);
    }
    if (!is_at_rest() && share == 0) break;
    if (share < 0.5)
      shift_ = is_at_rest() ? std::max(first_shift(), kShiftFactor * shift_) : 0;
    else if (share >= 1)
      shift_ = shift_ > kSmallestShift * first_shift() ? shift_ / kShiftFactor : 0;
  }
  report.status = SolveStatus::not_converged;
  report.message = "newton stopped after " + std::to_string(report.iterations) +
                   " iterations with its equations not solved";
  return report;
}

SolveReport StepperNewton::substep(State& state, double time_end, double h) {
  positions_begin_ = state.positions;
  if (model_.bend_friction)
    model_.bend_friction->begin_substep(state, h,
                                        options().rule == NewtonRule::midpoint
                                            ? BendFriction::Knee::in_middle
                                            : BendFriction::Knee::exact);
  if (model_.air && options().rule == NewtonRule::midpoint) model_.air->set_time(time_end - h / 2);
  if (pair_hold_) choose_pairs(state, time_end, h);
  set_up(state, h);
  place_first_guess(state, time_end);
  const int n_iterations = find_holds();
  SolveReport report = minimise(options().tolerance);
  report.iterations += n_iterations;
  if (report.ends_run()) return report;
  if (hold_ || pair_hold_) velocities_ = (positions_ - positions_begin_) / interval_;
  if (hold_) hold_->add_forces(velocities_, interval_, contact_memory_.forces());
  if (pair_hold_) pair_hold_->remember(velocities_, interval_, *cloth_contact_);
  switch (options().rule) {
    case NewtonRule::backward_euler:
      state.velocities = (positions_ - positions_begin_) / interval_;
      state.positions = positions_;
      break;
    case NewtonRule::midpoint:
      state.velocities = 2 / interval_ * (positions_ - positions_begin_) - state.velocities;
      state.positions = 2 * positions_ - positions_begin_;
      break;
    case NewtonRule::equilibrium:
      state.velocities.setZero();
      state.positions = positions_;
      break;
  }
  for (const Pin& pin : model_.pins) {
    state.positions.col(pin.vertex) = pin.position(time_end);
    state.velocities.col(pin.vertex) = is_at_rest() ? Vec3(Vec3::Zero()) : pin.velocity(time_end);
  }
  const double travel_share = options().rule == NewtonRule::midpoint ? 0.5 : 1;
  correct(state, time_end, h, hold_ ? hold_->resistances() : model_.masses, travel_share);
  return report;
}

}  // namespace pleat
