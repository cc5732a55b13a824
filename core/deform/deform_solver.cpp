#include "core/deform/deform_solver.h"

#include <cmath>

#include "core/base/check.h"
#include "core/base/rigid_motion.h"
#include "core/deform/cloth_extent.h"
#include "core/deform/deform_settling.h"
#include "core/linalg/make_linear_solver.h"

namespace pleat {
namespace {

constexpr int kMaxHalvings = 12;              // then the direction is at fault, not its length
constexpr double kSufficientDecrease = 1e-4;  // Armijo's: share of what the slope promises
constexpr double kFirstDamping = 1e-4;
constexpr double kDampingFactor = 10;
constexpr double kLargestDamping = 1e8;  // the step is then far below rounding
constexpr double kRounding = 1e-13;      // share of the energy, which is a sum over all triangles
/// A factor serves badly when the last of so many steps is not this much shorter than the first. A
/// new one costs about as much as five steps, and what was learnt is lost.
constexpr int kPatience = 25;
constexpr double kContraction = 0.01;
constexpr int kMostSteps = 200;
constexpr int kPatienceWithHalving = 2;  // L-BFGS halves a step now and then and goes on well
/// Factors in a row whose first step was halved more than that: the energy has a kink, as where a
/// triangle has collapsed, which another factor does not know either, but corrections learn.
constexpr int kFactorsInVain = 2;

/// The end is a short step after which less than this share of the energy is left to gain
/// (left_to_gain), or one of kNoStep, in which files and screens see no change.
constexpr double kWorthMore = 1e-7;
constexpr double kNoStep = 1e-8;  // DeformStep::relative_step

/// Steps that a hand's move takes at most; a gain of energy below this share is not seen.
constexpr int kStepsOfMove = 4;
constexpr double kWorthAStep = 1e-3;

constexpr double kBulge = 1e-3;  // share of the extent
/// [rad]; where what is held turns less, the linearised problem strains by less than 1 - cos(30
/// degrees) = 13 %, and steps find from there.
constexpr double kLargeTurn = M_PI / 6;

double dot(const Positions& a, const Positions& b) { return flat(a).dot(flat(b)); }

/// Unit normal of each vertex; zero where the triangles around it cancel.
Positions vertex_normals(const TriangleMesh& mesh) {
  const Positions& x = mesh.rest_positions;
  Positions normals = Positions::Zero(3, x.cols());
  for (const Triangle& t : mesh.triangles) {
    const Vec3 doubled_area =
        Vec3(x.col(t[1]) - x.col(t[0])).cross(Vec3(x.col(t[2]) - x.col(t[0])));
    for (const VertexId v : t) normals.col(v) += doubled_area;
  }
  for (auto normal : normals.colwise()) {
    const double length = normal.norm();
    if (length > 0) normal /= length;
  }
  return normals;
}

/// Moves up and down along the normals in waves of a fifth to a third of the extent, which depend
/// on the place alone and not on the mesh.
Positions bulges(const TriangleMesh& mesh, double extent) {
  const std::array<Vec3, 3> waves = {Vec3(19, 11, 7), Vec3(-13, 17, 29), Vec3(5, -31, 3)};
  Positions result = vertex_normals(mesh);
  const Vec3 corner = mesh.rest_positions.rowwise().minCoeff();
  for (Eigen::Index v = 0; v < result.cols(); ++v) {
    double height = 0;
    for (const Vec3& wave : waves)
      height += std::sin(wave.dot(mesh.rest_positions.col(v) - corner) / extent + 1);
    result.col(v) *= kBulge * extent * height / 3;
  }
  return result;
}

/// Estimates the energy that steps after `last` can still gain: where gains shrink by a factor q
/// from one span of steps to the next, the last span's over 1 - q. Before there are two spans it is
/// the gain of the last step.
double left_to_gain(const std::vector<DeformStep>& steps, const DeformStep& last, double before) {
  constexpr std::size_t kLongestSpan = 5;  // steps; single gains go up and down
  constexpr double kSlowest = 0.999;       // counts a thousand spans where gains do not shrink
  const std::size_t span = std::min(kLongestSpan, steps.size() / 2);
  if (span == 0) return before - last.energy;
  const double middle = steps[steps.size() - span].energy;
  const double recent = middle - last.energy;
  const double earlier = steps[steps.size() - 2 * span].energy - middle;
  return recent / (1 - std::min(recent / earlier, kSlowest));
}

bool are_equal(const DeformWeights& a, const DeformWeights& b) {
  return a.recovery == b.recovery && a.stretch == b.stretch && a.bending == b.bending;
}

}  // namespace

DeformSolver::DeformSolver(const TriangleMesh& mesh, EnergyForm form, const DeformWeights& weights)
    : energy_(mesh, form),
      weights_(weights),
      extent_(cloth_extent(mesh)),
      bulges_(bulges(mesh, extent_)),
      positions_(mesh.rest_positions),
      is_held_(static_cast<std::size_t>(positions_.cols()), 0),
      solver_(make_linear_solver(best_direct_solver())) {
  set_weights(weights);
}

DeformSolver::~DeformSolver() = default;

void DeformSolver::begin_anew() {
  steps_.clear();
  n_before_ = n_linearisations_;
  n_with_factor_ = 0;
  n_in_vain_ = 0;
  last_change_.resize(3, 0);
  converged_ = false;
}

void DeformSolver::set_weights(const DeformWeights& weights) {
  PLEAT_CHECK(weights.recovery >= 0 && weights.stretch >= 0 && weights.bending >= 0 &&
                  weights.recovery + weights.stretch + weights.bending > 0,
              "weights are not negative and not all zero");
  if (are_equal(weights, weights_)) return;
  const bool has_other_terms = (weights.stretch > 0) != (weights_.stretch > 0) ||
                               (weights.bending > 0) != (weights_.bending > 0);
  if (has_other_terms) has_pattern_ = false;
  weights_ = weights;
  has_factor_ = false;
  begin_anew();
}

void DeformSolver::hold(std::vector<VertexId> vertices) {
  held_ = std::move(vertices);
  energy_.hold(held_);
  std::fill(is_held_.begin(), is_held_.end(), 0);
  for (const VertexId v : held_) is_held_[v] = 1;
  has_factor_ = false;
  begin_anew();
}

bool DeformSolver::dampen() {
  damping_ = std::max(kFirstDamping, kDampingFactor * damping_);
  has_factor_ = false;
  return damping_ <= kLargestDamping;
}

SolveReport DeformSolver::linearise() {
  ++n_linearisations_;
  SparseMatrix constrained;
  {
    const PartScope scope(observer_, Part::assembly);
    metric_ = energy_.metric(weights_, positions_);
    metric_.diagonal().array() += damping_ * metric_.diagonal().mean();
    constrained = metric_;
    for (int column = 0; column < constrained.outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(constrained, column); entry; ++entry)
        if (is_held_[entry.row()] != 0 || is_held_[column] != 0)
          entry.valueRef() = entry.row() == column ? 1 : 0;
  }
  const PartScope scope(observer_, Part::factor);
  corrections_.clear();
  last_change_.resize(3, 0);
  n_with_factor_ = 0;
  is_stale_ = false;
  if (!has_pattern_) solver_->analyze(constrained);
  has_pattern_ = true;
  SolveReport report = solver_->factorize(constrained);
  has_factor_ = report.ok();
  return report;
}

Positions DeformSolver::free_gradient() const {
  const PartScope scope(observer_, Part::forces);
  Positions gradient = energy_.gradient(weights_, positions_);
  for (const VertexId v : held_) gradient.col(v).setZero();
  return gradient;
}

/// The shape in which the linearised problem is at rest once what is held has moved.
Positions DeformSolver::foreseen(const Positions& moves) {
  const PartScope scope(observer_, Part::solve);
  Positions change = Positions::Zero(3, positions_.cols());
  for (std::size_t k = 0; k < held_.size(); ++k)
    change.col(held_[k]) = moves.col(static_cast<Eigen::Index>(k));
  const Eigen::MatrixXd pull = metric_.selfadjointView<Eigen::Lower>() * change.transpose();
  Positions load = free_gradient() + pull.transpose();
  for (const VertexId v : held_) load.col(v).setZero();
  return positions_ + change + descent(load);
}

/// Takes `shape`, with what is held left in place, if it has less energy than the present one.
void DeformSolver::take_if_lower(Positions shape) {
  for (const VertexId v : held_) shape.col(v) = positions_.col(v);
  if (energy_.terms(shape).weighted(weights_) < energy()) positions_ = std::move(shape);
}

void DeformSolver::move_held(const PositionsView& places) {
  PLEAT_CHECK(places.cols() == static_cast<Eigen::Index>(held_.size()), "a place per held vertex");
  const Positions moves = places - held_places();
  if (moves.isZero(0)) return;
  begin_anew();
  const bool foresees = has_factor_ || linearise().ok();
  Positions followed = foresees ? foreseen(moves) : positions_;
  for (std::size_t k = 0; k < held_.size(); ++k)
    positions_.col(held_[k]) = places.col(static_cast<Eigen::Index>(k));
  take_if_lower(std::move(followed));
}

SolveReport DeformSolver::follow(const PositionsView& places) {
  move_held(places);
  const int n_before = n_linearisations_;
  double before = energy();
  SolveReport report;
  for (int k = 0; k < kStepsOfMove && report.ok() && !converged_; ++k) {
    report = step(n_linearisations_ == n_before ? Linearise::when_needed : Linearise::never);
    const double after = steps_.empty() ? before : steps_.back().energy;
    if (after > (1 - kWorthAStep) * before && !is_stale_) break;
    before = after;
  }
  return report;
}

Positions DeformSolver::held_places() const {
  Positions places(3, static_cast<Eigen::Index>(held_.size()));
  for (std::size_t k = 0; k < held_.size(); ++k)
    places.col(static_cast<Eigen::Index>(k)) = positions_.col(held_[k]);
  return places;
}

/// The metric is the same for a shape however turned: a factor made before serves after.
void DeformSolver::restart(const PositionsView& places) {
  const Positions bent = energy_.rest_positions() + bulges_;
  positions_ = bent;
  for (const VertexId v : held_) positions_.col(v) = energy_.rest_positions().col(v);
  has_factor_ = false;
  damping_ = 0;
  begin_anew();
  const Positions rest_places = held_places();
  move_held(places);
  if (held_.empty()) return;
  const RigidMotion motion = nearest_rigid_motion(rest_places, places);
  if (motion.angle() > kLargeTurn) take_if_lower(motion.of(bent));
}

Positions DeformSolver::descent(const Positions& gradient) {
  const PartScope scope(observer_, Part::solve);
  return corrections_.descent(gradient, [this](const Positions& q) {
    Eigen::MatrixXd solution(q.cols(), 3);
    solver_->solve(q.transpose(), solution);
    return Positions(solution.transpose());
  });
}

/// Moves along the direction until the energy has fallen enough from what it was before; false, and
/// nothing moved, if it does not.
bool DeformSolver::descend(const Positions& direction, double slope, double before,
                           DeformStep& step) {
  const PartScope scope(observer_, Part::forces);
  const Positions start = positions_;
  double share = 1;
  for (step.halvings = 0; step.halvings <= kMaxHalvings; ++step.halvings, share /= 2) {
    positions_ = start + share * direction;
    step.terms = terms();
    step.energy = step.terms.weighted(weights_);
    if (!(step.energy <= before + kSufficientDecrease * share * slope)) continue;
    last_change_ = share * direction;
    const double n_free =
        static_cast<double>(positions_.cols()) - static_cast<double>(held_.size());
    step.relative_step = last_change_.norm() / std::sqrt(n_free) / extent_;
    return true;
  }
  positions_ = start;
  return false;
}

/// Judges by a step, from the energy `before`, whether the factor serves and the end is reached.
void DeformSolver::judge(const DeformStep& step, double before) {
  const bool is_halved = step.halvings > kPatienceWithHalving;
  if (n_with_factor_++ == 0) {
    first_with_factor_ = step.relative_step;
    n_in_vain_ = is_halved ? n_in_vain_ + 1 : 0;
  }
  is_stale_ =
      (is_halved && n_in_vain_ < kFactorsInVain) || n_with_factor_ >= kMostSteps ||
      (n_with_factor_ >= kPatience && step.relative_step > kContraction * first_with_factor_);
  if (step.halvings > 0) return;
  const bool gains = left_to_gain(steps_, step, before) > kWorthMore * before;
  converged_ = step.relative_step <= (gains ? kNoStep : kTolerance);
  damping_ = damping_ > kFirstDamping ? damping_ / kDampingFactor : 0;
}

SolveReport DeformSolver::step(Linearise allowed) {
  if (converged_) return {};
  const bool may_linearise = allowed == Linearise::when_needed;
  const Positions gradient = free_gradient();
  remember(gradient);
  const double before = energy();
  DeformStep step;
  for (;;) {
    if (!has_factor_ || (is_stale_ && may_linearise)) {
      SolveReport report = linearise();
      step.linearised = true;
      if (!report.ok() && !dampen()) return report;
      if (!report.ok()) continue;
    }
    const Positions direction = descent(gradient);
    const double slope = dot(gradient, direction);
    if (!std::isfinite(slope))
      return {SolveStatus::not_finite, 0, 0, "the energy or its derivative is not finite"};
    converged_ = -slope <= kRounding * before;
    if (converged_) return {};
    step.damping = damping_;
    if (descend(direction, slope, before, step)) break;
    is_stale_ = true;
    const bool is_factor_alone = corrections_.empty();
    corrections_.clear();
    if (is_factor_alone && !may_linearise)
      return {SolveStatus::not_converged, 0, 0, "the factor at hand leads no further down"};
    if (is_factor_alone && step.linearised && !dampen())
      return {SolveStatus::not_converged, 0, 0, "no step makes the energy smaller"};
  }
  judge(step, before);
  last_gradient_ = gradient;
  steps_.push_back(step);
  return {};
}

SolveReport DeformSolver::step_towards_end(int max_linearisations) {
  const bool is_last = n_recent_linearisations() >= max_linearisations;
  SolveReport report = step(is_last ? Linearise::never : Linearise::when_needed);
  if (report.ok() && is_last && is_stale_)
    return {SolveStatus::not_converged, 0, 0, "the cap of linearisations is reached"};
  return report;
}

SolveReport DeformSolver::solve(int max_linearisations) {
  SolveReport report;
  while (!converged_ && report.ok()) report = step_towards_end(max_linearisations);
  report.iterations = n_recent_linearisations();
  return report;
}

void DeformSolver::take_back(DeformShape shape) {
  PLEAT_CHECK(shape.positions.cols() == positions_.cols(), "a shape of the same mesh");
  begin_anew();
  has_factor_ = false;
  positions_ = std::move(shape.positions);
  steps_ = std::move(shape.steps);
  converged_ = shape.converged;
}

SolveReport DeformSolver::settle(int max_linearisations) {
  DeformSettling settling(*this, DeformSettling::Ways::from_here_and_rest, max_linearisations);
  while (!settling.done()) settling.step();
  return settling.report();
}

}  // namespace pleat
