#include "core/run/convergence_study.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "core/base/check.h"
#include "core/dynamics/position_based/converged_step.h"
#include "core/dynamics/position_based/step_solve.h"
#include "core/dynamics/stepper_table.h"
#include "core/run/part_timer.h"
#include "core/run/simulation.h"

namespace pleat {
namespace {

constexpr double kBatch = 0.05;  // [s]

/// Leaves of the diagonals those that are edges of the surface, each with the stiffness of two.
void keep_one_diagonal(ClothModel& model) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const MeshEdge& edge : mesh_edges(model.surface.triangles))
    edges.insert(std::minmax(edge.a.value, edge.b.value));
  const auto is_other = [&](const Spring& spring) {
    return spring.kind == SpringKind::shear &&
           edges.count(std::minmax(spring.a.value, spring.b.value)) == 0;
  };
  model.springs.erase(std::remove_if(model.springs.begin(), model.springs.end(), is_other),
                      model.springs.end());
  for (Spring& spring : model.springs)
    if (spring.kind == SpringKind::shear) {
      spring.stiffness *= 2;
      spring.damping *= 2;
    }
}

/// Parts that take the time: the run until the step, the rounds, and the time of each number of
/// them.
constexpr int kRunPart = 0, kRoundsPart = 1, kTimesPart = 2, kParts = 3;

/// So many of a part's pieces are done.
void tell(const ConvergenceOptions& options, int part, double done, double all) {
  if (options.on_progress) options.on_progress((part + done / all) / kParts);
}

/// A model with its surface, and the state that the step begins in.
struct Begin {
  ClothModel model;
  State state;
  double time = 0;  // [s]
};

void check_cloth(const Simulation& simulation) {
  const ClothModel& model = simulation.model();
  if (!model.is_plain_spring_lattice() || model.springs.empty())
    throw InputError("/model", "expected springs with quadratic bending or none");
  if (!model.hanging.empty())
    throw InputError("/refinement", "expected a uniform mesh, on which no vertex hangs");
  if (simulation.triangles().empty())
    throw InputError("/cloth", "expected a surface, of which coarser levels are made");
}

Begin run_until(const Scene& scene, const ConvergenceOptions& options) {
  Simulation simulation(scene);
  check_cloth(simulation);
  const auto n_steps = std::llround(options.time / scene.method.step);
  for (std::int64_t s = 0; s < n_steps; ++s) {
    if (const SolveReport report = simulation.step(); report.ends_run())
      throw InputError("/method", "the run ended before the step: " + report.message);
    tell(options, kRunPart, static_cast<double>(s + 1), static_cast<double>(n_steps));
  }
  Begin begin{simulation.model(), simulation.state(), simulation.time()};
  begin.model.surface = {simulation.rest_positions(), simulation.triangles(), {}};
  begin.model.air.reset();
  begin.model.contact.reset();
  begin.model.strain_limit.reset();
  if (options.diagonals == Diagonals::one) keep_one_diagonal(begin.model);
  return begin;
}

/// Root of the mean square over vertices that are not pinned.
double rms_distance(const ClothModel& model, const Positions& x, const Positions& y) {
  if (y.cols() == 0) return std::nan("");
  return std::sqrt((x - y).squaredNorm() /
                   static_cast<double>(x.cols() - static_cast<Eigen::Index>(model.pins.size())));
}

/// A method's way to a step's end, from the start with so many rounds.
class StepMethod {
 public:
  virtual ~StepMethod() = default;
  virtual void solve(int rounds) = 0;
  virtual ConvergencePoint point_after(int rounds) = 0;  // requires a solve before
  virtual bool takes_rounds() const = 0;
  virtual bool has_error() const = 0;
};

/// Solution of a method's own equations; no columns where that is not known.
struct Converged {
  Positions positions;
  double distance_begin = std::nan("");
  double unknown = std::nan("");
};

class PositionBased final : public StepMethod {
 public:
  PositionBased(const ClothModel& model, const MethodOptions& method, const PredictedStep& step,
                const Converged& converged)
      : model_(model), converged_(converged), solve_(model, method, step) {}

  void solve(int rounds) override { solve_.solve(rounds); }
  ConvergencePoint point_after(int rounds) override {
    return {
        rounds, rounds * solve_.sweeps_per_round(), 0, solve_.relative_error(),
        rms_distance(model_, solve_.positions(), converged_.positions) / converged_.distance_begin};
  }
  bool takes_rounds() const override { return true; }
  bool has_error() const override { return true; }

 private:
  const ClothModel& model_;
  const Converged& converged_;
  StepSolve solve_;
};

class WholeStep final : public StepMethod {
 public:
  WholeStep(const ClothModel& model, const MethodOptions& method, const State& state, double time,
            const Converged& converged)
      : model_(model), method_(method), begin_(state), time_(time), converged_(converged) {}

  void solve(int rounds) override {
    if (!stepper_ || rounds != method_.iterations) {
      method_.iterations = rounds;
      stepper_ = make_stepper(model_, method_);
      state_ = begin_;
      stepper_->advance(state_, time_);
    }
    state_ = begin_;
    stepper_->advance(state_, time_);
  }
  ConvergencePoint point_after(int rounds) override {
    ConvergencePoint point;
    point.rounds = rounds;
    point.relative_distance =
        rms_distance(model_, state_.positions, converged_.positions) / converged_.distance_begin;
    return point;
  }
  bool takes_rounds() const override { return method_.stepper->reads("iterations"); }
  bool has_error() const override { return false; }

 private:
  ClothModel model_;
  MethodOptions method_;
  State begin_, state_;
  double time_;
  const Converged& converged_;
  std::unique_ptr<Stepper> stepper_;
};

Converged converged_positions(const Begin& begin, const PredictedStep& step,
                              Constraints constraints) {
  if (constraints == Constraints::rigid) return {};
  const ConvergedStep found = converged_step(begin.model, step);
  return {found.positions, rms_distance(begin.model, step.predicted, found.positions),
          found.is_converged ? found.last_change : std::nan("")};
}

Converged converged_by_newton(const Begin& begin, const PredictedStep& step) {
  ClothModel model = begin.model;
  MethodOptions newton = steppers::kNewton.usual_method();
  newton.step = step.h;
  newton.tolerance = 1e-12;
  State state = begin.state;
  const SolveReport report = make_stepper(model, newton)->advance(state, begin.time);
  return {state.positions, rms_distance(model, step.predicted, state.positions),
          report.ok() ? newton.tolerance * box_diagonal(step.begins) : std::nan("")};
}

/// 1, 2, 3, 5, 9, ..., and before the first of these that reaches a target those that it takes.
std::vector<ConvergencePoint> points_of(StepMethod& step_method,
                                        const ConvergenceOptions& options) {
  std::vector<ConvergencePoint> points;
  const auto measure = [&](int rounds) {
    step_method.solve(rounds);
    return step_method.point_after(rounds);
  };
  const double least = options.targets.empty()
                           ? 0
                           : *std::min_element(options.targets.begin(), options.targets.end());
  for (int more = 0, rounds = 1; rounds <= options.most_rounds; rounds = 1 + more) {
    const Stopwatch watch;
    points.push_back(measure(rounds));
    const bool is_enough =
        points.back().relative_error <= least || watch.elapsed() > options.longest_solve;
    if (!step_method.takes_rounds() || is_enough) break;
    more = more == 0 ? 1 : 2 * more;
  }
  if (!step_method.has_error()) return points;
  for (const double target : options.targets) {
    const auto at = std::find_if(points.begin(), points.end(), [&](const ConvergencePoint& point) {
      return point.relative_error <= target;
    });
    if (at == points.end() || at == points.begin()) continue;
    int above = std::prev(at)->rounds;
    ConvergencePoint below = *at;
    while (below.rounds - above > 1) {
      const int middle = (above + below.rounds) / 2;
      const ConvergencePoint point = measure(middle);
      if (point.relative_error <= target)
        below = point;
      else
        above = middle;
    }
    if (below.rounds != at->rounds) points.insert(at, below);
  }
  return points;
}

/// Time of one solve, in a batch of many [ms].
double timed(StepMethod& step_method, int rounds) {
  step_method.solve(rounds);
  int n = 0;
  const Stopwatch watch;
  do {
    step_method.solve(rounds);
    ++n;
  } while (watch.elapsed() < kBatch);
  return 1e3 * watch.elapsed() / n;
}

/// Median; of an even number of values, the lower one in the middle.
double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// One batch of each number of rounds of each method in turn, so that a change of the
/// machine's speed meets all of them alike.
void add_times(std::vector<ConvergenceSeries>& series,
               const std::vector<std::unique_ptr<StepMethod>>& step_methods,
               const ConvergenceOptions& options) {
  std::vector<std::vector<std::vector<double>>> times(series.size());
  for (std::size_t i = 0; i < series.size(); ++i) times[i].resize(series[i].points.size());
  std::size_t most = 0;
  for (const ConvergenceSeries& one : series) most = std::max(most, one.points.size());
  for (int round = 0; round < options.repeat; ++round)
    for (std::size_t p = 0; p < most; ++p) {
      for (std::size_t i = 0; i < series.size(); ++i)
        if (p < series[i].points.size())
          times[i][p].push_back(timed(*step_methods[i], series[i].points[p].rounds));
      tell(options, kTimesPart, round + static_cast<double>(p + 1) / static_cast<double>(most),
           options.repeat);
    }
  for (std::size_t i = 0; i < series.size(); ++i)
    for (std::size_t p = 0; p < series[i].points.size(); ++p)
      series[i].points[p].ms = median(times[i][p]);
}

}  // namespace

ConvergenceStudy study_convergence(const Scene& scene, const ConvergenceOptions& options) {
  PLEAT_CHECK(options.time >= 0 && options.most_rounds >= 1 && options.repeat >= 1,
              "a time from 0 on, a round and a batch at least");
  const Begin begin = run_until(scene, options);
  const double h = scene.method.step;
  const PredictedStep step = predicted_step(begin.model, begin.state, begin.time + h, h);
  ConvergenceStudy study;
  study.time = begin.time;
  study.step = h;
  study.n_vertices = begin.model.n_vertices();
  study.n_springs = static_cast<int>(begin.model.springs.size());
  study.n_bends = static_cast<int>(begin.model.bends.size());
  std::optional<Converged> projected, solved;
  std::vector<std::unique_ptr<StepMethod>> step_methods;
  for (MethodOptions method : options.methods) {
    method.step = h;
    method.substeps = 1;
    const bool is_position_based = method.stepper->make_projections != nullptr;
    if (is_position_based) method.constraints = options.constraints;
    std::optional<Converged>& converged = is_position_based ? projected : solved;
    if (!converged)
      converged = is_position_based ? converged_positions(begin, step, options.constraints)
                                    : converged_by_newton(begin, step);
    if (is_position_based)
      step_methods.push_back(
          std::make_unique<PositionBased>(begin.model, method, step, *converged));
    else
      step_methods.push_back(
          std::make_unique<WholeStep>(begin.model, method, begin.state, begin.time, *converged));
    study.series.push_back({method, points_of(*step_methods.back(), options),
                            converged->distance_begin, converged->unknown});
    tell(options, kRoundsPart, static_cast<double>(step_methods.size()),
         static_cast<double>(options.methods.size()));
  }
  add_times(study.series, step_methods, options);
  return study;
}

}  // namespace pleat
