#include "core/run/run_advice.h"

#include <algorithm>
#include <cmath>

#include "core/dynamics/stepper_table.h"
#include "core/linalg/make_linear_solver.h"

namespace pleat {
namespace {

using Kind = RunWarning::Kind;

constexpr double kFrame = 1.0 / 60;  // [s]: longer substeps fold cloth as no cloth does

/// Count that a scene may have.
int capped(double count, int most) {
  return static_cast<int>(std::min(std::ceil(count), static_cast<double>(most)));
}

/// Stepper that comes to rest on any mesh, in the same step.
MethodOptions calm_method(const MethodOptions& method) {
  MethodOptions calm = steppers::kImplicitEuler.usual_method();
  calm.step = method.step;
  calm.substeps = capped(4 * std::max(std::ceil(method.step / kFrame - 1e-6), 1.0), kMaxSubsteps);
  return calm;
}

SettingHint calm_hint(const MethodOptions& method) {
  const MethodOptions calm = calm_method(method);
  return {"/method",
          {{"stepper", calm.stepper->name}, {"step_s", calm.step}, {"substeps", calm.substeps}}};
}

/// Cost of a second, in the units of a stepper's substep_cost.
double cost_of(const MethodOptions& method) {
  return method.substeps * method.stepper->substep_cost(method) / method.step;
}

/// Power of 2, from 4 on, by which substeps are to grow. Errors fall with their square, or where
/// constraints are swept over, with their power of 3/2; a quarter of what is bearable is aimed at.
int times_for(double excess, bool is_swept) {
  constexpr int kLeast = 4;
  constexpr int kMost = 64;
  const double over = 4 * excess;
  const auto suffices = [&](double times) {
    return is_swept ? times * times * times >= over * over : times * times >= over;
  };
  int times = kLeast;
  while (times < kMost && !suffices(times)) times *= 2;
  return times;
}

/// Changes of settings beside the counts that are known to leave errors or to feed them.
std::vector<SettingHint> hints_of_settings(Kind kind, const MethodOptions& method) {
  const StepperType& type = *method.stepper;
  const bool is_unsolved = kind == Kind::unsolved || kind == Kind::not_converged;
  std::vector<SettingHint> hints;
  if (is_unsolved && type.reads("solver") && method.solver == SolverKind::cg)
    hints.push_back({"/method/solver", name(SolverKind::supernodal)});
  if (type.reads("tolerance") && !is_direct(method.solver) && method.tolerance > type.tolerance)
    hints.push_back({"/method/tolerance", type.tolerance});
  if (type.reads("rule") && method.rule == NewtonRule::midpoint)
    hints.push_back({"/method/rule", "backward_euler"});
  return hints;
}

/// More of what the stepper takes more of, and where that is of sweeps or rounds, a stepper that
/// solves for equilibrium; the cheaper one first.
std::vector<SettingHint> hints_of_counts(double excess, const MethodOptions& method) {
  const StepperType& type = *method.stepper;
  const bool takes_rounds = type.reads("iterations");
  const int times = times_for(excess, takes_rounds);
  if (method.substeps == kStableSubsteps) return {{"/method/step_s", method.step / times}};
  if (type.has_stability_bound) return {{"/method/substeps", "stable"}};
  MethodOptions more = method;
  SettingHint hint;
  if (takes_rounds && type.solves_whole_substeps) {
    more.iterations = std::max(type.start.iterations, capped(4.0 * method.iterations, kMaxSweeps));
    // Errors fall at most as fast as rounds grow: more of them cost more than equilibrium does.
    if (excess * method.iterations > more.iterations) return {calm_hint(method)};
    hint = {"/method/iterations", more.iterations};
  } else {
    const double frames = type.solves_whole_substeps ? method.step / kFrame : 0;
    const double wanted = std::max(static_cast<double>(times) * method.substeps, frames);
    more.substeps = std::max(type.start.substeps, capped(wanted, kMaxSubsteps));
    hint = {"/method/substeps", more.substeps};
  }
  if (!takes_rounds) return {hint};
  if (cost_of(calm_method(method)) < cost_of(more)) return {calm_hint(method), hint};
  return {hint, calm_hint(method)};
}

}  // namespace

std::vector<SettingHint> hints_for(Kind kind, double excess, const Scene& scene) {
  const MethodOptions& method = scene.method;
  if (kind == Kind::blocked) return {};
  if (kind == Kind::given_up) return {{"/method/solver", name(SolverKind::supernodal)}};
  if (kind == Kind::unbalanced && method.stepper->reads("iterations")) return {calm_hint(method)};
  std::vector<SettingHint> hints = hints_of_settings(kind, method);
  for (SettingHint& hint : hints_of_counts(excess, method)) hints.push_back(std::move(hint));
  return hints;
}

}  // namespace pleat
