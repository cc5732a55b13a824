#include "core/run/rest_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/dynamics/stepper_table.h"

namespace pleat {
namespace {

/// Cloth is at rest that has moved, but for a common drift, with no more RMS speed than this [m/s]
/// over the time below [s]: to speed up from rest or turn round within it takes less than 5 % of
/// its weight.
constexpr double kRestSpeed = 0.05;
constexpr double kRestTime = 0.5;
/// Share of the weight that may be unbalanced. States that were right had at most 0.02, such as
/// were wrong 0.5 and more.
constexpr double kUnbalanced = 0.05;
/// Share of the steps' work that looks may take.
constexpr double kShareOfWork = 0.01;
/// First look's cost per vertex as long as none is known, in units of StepperType::substep_cost.
constexpr double kFirstLook = 350;

Vec3 drift_of(const Simulation& simulation) {
  const Eigen::VectorXd& masses = simulation.model().masses;
  return simulation.state().velocities * masses / masses.sum();
}

/// Speed against a drift [m/s].
double rms_speed(const Simulation& simulation, const Vec3& drift) {
  const Eigen::VectorXd& masses = simulation.model().masses;
  const Positions& velocities = simulation.state().velocities;
  double sum = 0;
  for (Eigen::Index i = 0; i < velocities.cols(); ++i)
    sum += masses[i] * squared_distance(velocities, i, drift.data());
  return std::sqrt(sum / masses.sum());
}

double work_of_step(const Simulation& simulation) {
  const MethodOptions& method = simulation.scene().method;
  return simulation.substeps() * method.stepper->substep_cost(method);
}

}  // namespace

RestWatch::RestWatch(const Simulation& simulation)
    : topology_(simulation.topology()),
      n_steps_(simulation.n_steps()),
      work_of_next_look_(kFirstLook),
      rest_begin_(simulation.time()),
      interval_begin_(rest_begin_) {
  const Vec3 drift = drift_of(simulation);
  begin_interval(simulation, drift);
}

void RestWatch::begin_interval(const Simulation& simulation, const Vec3& drift) {
  interval_begin_ = simulation.time();
  drift_ = drift;
  fastest_before_ = fastest_;
  fastest_ = rms_speed(simulation, drift);
}

void RestWatch::follow(const Simulation& simulation) {
  const double time = simulation.time();
  fastest_ = std::max(fastest_, rms_speed(simulation, drift_));
  const bool moves = fastest_ > kRestSpeed;
  if (!moves && time - interval_begin_ < kRestTime) return;
  begin_interval(simulation, drift_of(simulation));
  if (!moves) return;
  rest_begin_ = time;
  fastest_before_ = 0;
}

bool RestWatch::is_at_rest(const Simulation& simulation) const {
  return simulation.time() - rest_begin_ >= kRestTime && fastest_ <= kRestSpeed;
}

// Cloth that trembles at a frequency w with a speed v is out of balance by v w, of which a step of
// h sees v w/(1 + (h w)^2), at most v/(2 h).
std::optional<RestWatch::Look> RestWatch::look(const Simulation& simulation) {
  if (std::exchange(topology_, simulation.topology()) != topology_) check_.reset();
  const double before = check_ ? check_->work() : 0;
  if (!check_) check_.emplace(simulation.model());
  const auto share = check_->unbalanced_share(simulation.state(), simulation.time(),
                                              simulation.stepper().cloth_contact());
  work_of_next_look_ = check_->work() - before;
  work_ += work_of_next_look_;
  if (!share) return std::nullopt;
  const double trembling = std::max(fastest_, fastest_before_) /
                           (2 * kEquilibriumStep * simulation.model().gravity.norm());
  last_ = Look{simulation.time(), *share, kUnbalanced + trembling};
  return last_;
}

std::optional<RestWatch::Look> RestWatch::after_step(const Simulation& simulation) {
  const auto n_steps = static_cast<double>(simulation.n_steps() - n_steps_);
  n_steps_ = simulation.n_steps();
  work_of_steps_ += n_steps * work_of_step(simulation);
  follow(simulation);
  const bool is_due = work_ + work_of_next_look_ <= kShareOfWork * work_of_steps_;
  return is_due && is_at_rest(simulation) ? look(simulation) : std::nullopt;
}

std::optional<RestWatch::Look> RestWatch::at_end(const Simulation& simulation) {
  if (last_ && last_->time == simulation.time()) return last_;
  last_.reset();
  return is_at_rest(simulation) ? look(simulation) : std::nullopt;
}

}  // namespace pleat
