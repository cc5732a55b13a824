#include "core/dynamics/stepper_table.h"

#include <array>

#include "core/base/check.h"
#include "core/dynamics/explicit/stepper_explicit.h"
#include "core/dynamics/explicit/stepper_rk4.h"
#include "core/dynamics/implicit/stepper_imex.h"
#include "core/dynamics/implicit/stepper_implicit.h"
#include "core/dynamics/implicit/stepper_newton.h"
#include "core/dynamics/implicit/stepper_projective.h"
#include "core/dynamics/method_settings.h"
#include "core/dynamics/position_based/levels/cycle_projections.h"
#include "core/dynamics/position_based/stepper_position_based.h"
#include "core/linalg/make_linear_solver.h"

namespace pleat {
namespace {

template <class Type>
std::unique_ptr<Stepper> make(ClothModel& model, const MethodOptions& options) {
  return std::make_unique<Type>(model, options);
}

std::unique_ptr<Stepper> make_position_based(ClothModel& model, const MethodOptions& options) {
  return std::make_unique<StepperPositionBased>(model, options, options.stepper->make_projections);
}

constexpr auto kExplicitSettings =
    method_settings("substeps", "beyond_bound", "euler", "first_contact_m");
constexpr auto kRk4Settings = method_settings("substeps", "beyond_bound", "first_contact_m");
constexpr auto kImplicitSettings =
    method_settings("substeps", "solver", "tolerance", "preconditioner", "first_contact_m");
constexpr auto kImexSettings =
    method_settings("substeps", "solver", "tolerance", "omega", "preconditioner", "split",
                    "explicit_share", "first_contact_m");
constexpr auto kProjectiveSettings =
    method_settings("substeps", "iterations", "solver", "acceleration");
constexpr auto kXpbdSettings = method_settings("substeps", "iterations", "constraints");
constexpr auto kPbdSettings =
    method_settings("substeps", "iterations", "constraints", "smoother", "omega", "attachments");
constexpr auto kHpbdSettings = method_settings("substeps", "iterations", "levels", "level_lengths",
                                               "smoother", "omega", "attachments");
constexpr auto kMultigridSettings =
    method_settings("substeps", "iterations", "levels", "ratio", "level_lengths", "smoother_before",
                    "smoother", "omega", "attachments", "carried_acceleration");
constexpr auto kNewtonSettings =
    method_settings("substeps", "solver", "tolerance", "preconditioner", "rule");

constexpr std::array<MethodCounts, 1> kStable = {{{kStableSubsteps, 1}}};
constexpr std::array<MethodCounts, 2> kOneOrFour = {{{1, 1}, {4, 1}}};
constexpr std::array<MethodCounts, 2> kFiveRounds = {{{1, 5}, {4, 5}}};
constexpr std::array<MethodCounts, 2> kTenSweeps = {{{1, 10}, {4, 10}}};
constexpr std::array<MethodCounts, 3> kSmallSteps = {{{10, 1}, {30, 1}, {100, 1}}};

constexpr const char* kDampedSubsteps = "More substeps damp less and cost more.";
constexpr const char* kZeroIsStable = "0: as many as its stability bound asks for.";

}  // namespace

constinit const StepperType steppers::kImplicitEuler = {
    .name = "implicit",
    .title = "Implicit",
    .meaning =
        "Safe at long steps, but takes some swing out of the cloth: backward Euler, one sparse "
        "system a substep.",
    .settings = kImplicitSettings,
    .substeps_meaning = kDampedSubsteps,
    .takes_bend_friction = true,
    .solves_equations = true,
    .solves_whole_substeps = true,
    .usual_counts = kOneOrFour,
    .is_usual_for_springs = true,
    .is_usual_for_membranes = true,
    // Some ten steps with a matrix of 3x3 blocks, or a factorisation.
    .substep_cost =
        [](const MethodOptions& options) { return is_direct(options.solver) ? 150.0 : 20.0; },
    .mark = {"M-4.5 0a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0 -9 0Z", "#17638f", "#7cc3f0"},
    .make = make<StepperImplicit>,
};

constinit const StepperType steppers::kImex = {
    .name = "imex",
    .title = "Implicit-explicit",
    .meaning =
        "Implicit for the springs that are too stiff for the substep, explicit for the others: a "
        "smaller system than Implicit's, and less damping.",
    .settings = kImexSettings,
    .substeps_meaning = "The more substeps, the fewer springs are implicit.",
    .start = {4, 1},
    .tolerance = 1e-4,
    .needs_springs = true,
    .solves_equations = true,
    .solves_whole_substeps = true,
    .usual_counts = kOneOrFour,
    // All forces, and a few sweeps over the blocks of the stiff springs.
    .substep_cost =
        [](const MethodOptions& options) { return is_direct(options.solver) ? 80.0 : 10.0; },
    .mark = {"M-5 0L-2.5-4.3H2.5L5 0L2.5 4.3H-2.5Z", "#0b6e5f", "#5fd0bb"},
    .make = make<StepperImex>,
};

constinit const StepperType steppers::kProjective = {
    .name = "projective",
    .title = "Projective",
    .meaning = "Gives each spring its length alone, then solves one constant system; and repeats.",
    .settings = kProjectiveSettings,
    .substeps_meaning = "More substeps damp less.",
    .iterations_meaning = "More rounds come closer to Implicit.",
    .start = {1, 10},
    .needs_springs = true,
    .needs_factor = true,
    .solves_equations = true,
    .solves_whole_substeps = true,
    .usual_counts = kFiveRounds,
    .is_usual_for_springs = true,
    // Two triangular solves a round, with a factor that is kept; half as much again to foretell.
    .substep_cost =
        [](const MethodOptions& options) {
          return (options.acceleration == Acceleration::none ? 3.0 : 4.5) * options.iterations;
        },
    .mark = {"M-4.2-4.2H4.2V4.2H-4.2Z", "#a34d00", "#f2a35e"},
    .make = make<StepperProjective>,
};

constinit const StepperType steppers::kXpbd = {
    .name = "xpbd",
    .title = "XPBD",
    .meaning = "Moves the two ends of each spring in turn, in many small substeps.",
    .settings = kXpbdSettings,
    .substeps_meaning = "More substeps: stiffer and less damped.",
    .iterations_meaning = "Sweeps over all springs in one substep.",
    .start = {30, 1},
    .needs_springs = true,
    .is_single_precision = true,
    .solves_equations = true,
    .usual_counts = kSmallSteps,
    .is_usual_for_springs = true,
    // Single precision, four springs at a time, and no forces but the air's, which cost most of it.
    .substep_cost = [](const MethodOptions& options) { return 1.0 * options.iterations; },
    .mark = {"M0-5.4L5 3.8H-5Z", "#4f6f00", "#b3d15a"},
    .make_projections = lane_projections,
    .make = make_position_based,
};

constinit const StepperType steppers::kPbd = {
    .name = "pbd",
    .title = "PBD",
    .meaning =
        "Moves the ends of each spring in turn, over and over in one long step. Soft on fine "
        "meshes.",
    .settings = kPbdSettings,
    .substeps_meaning = "More substeps: stiffer and less damped.",
    .iterations_meaning = "Sweeps over all springs in one substep.",
    .start = {1, 10},
    .set_start = [](MethodOptions& method) { method.constraints = Constraints::rigid; },
    .needs_springs = true,
    .is_single_precision = true,
    .usual_counts = kTenSweeps,
    .substep_cost = [](const MethodOptions& options) { return 1.5 * options.iterations; },
    .mark = {"M-4.6-2.7L0-5.3L4.6-2.7V2.7L0 5.3L-4.6 2.7Z", "#7a5c00", "#e0c060"},
    .make_projections = cycle_projections,
    .make = make_position_based,
};

constinit const StepperType steppers::kHpbd = {
    .name = "hpbd",
    .title = "Hierarchical PBD",
    .meaning =
        "PBD with coarser levels of 2008: every vertex that a level leaves out has two neighbours "
        "on it.",
    .settings = kHpbdSettings,
    .substeps_meaning = "More substeps: stiffer and less damped.",
    .iterations_meaning = "Cycles over all levels in one substep.",
    .start = {1, 5},
    .set_start =
        [](MethodOptions& method) {
          method.constraints = Constraints::rigid;
          method.selection = LevelSelection::thinned;
          method.level_lengths = LevelLengths::chord;
          method.levels = 3;
        },
    .needs_surface = true,
    .needs_springs = true,
    .is_single_precision = true,
    .usual_counts = kFiveRounds,
    .substep_cost = [](const MethodOptions& options) { return 2.5 * options.iterations; },
    .mark = {"M-5 3.6L0-5L5 3.6L0 0.8Z", "#5b5f6b", "#b4bac8"},
    .make_projections = cycle_projections,
    .make = make_position_based,
};

constinit const StepperType steppers::kMultigrid = {
    .name = "multigrid",
    .title = "Multigrid PBD",
    .meaning =
        "Projects lengths on ever coarser meshes first, so that a pull travels far at once, and "
        "hands the moves back to the finer ones.",
    .settings = kMultigridSettings,
    .substeps_meaning = "More substeps: stiffer and less damped.",
    .iterations_meaning = "Cycles over all levels in one substep.",
    .start = {10, 1},
    .set_start =
        [](MethodOptions& method) {
          method.constraints = Constraints::rigid_threads;
          method.levels = 3;
          method.ratio = 0.25;
          method.smoother_before = method.smoother_after = Smoother::lines;
          method.attachments = Attachments::long_range;
        },
    .needs_surface = true,
    .needs_springs = true,
    .is_single_precision = true,
    .usual_counts = kSmallSteps,
    .is_usual_for_springs = true,
    .substep_cost = [](const MethodOptions& options) { return 2.0 * options.iterations; },
    .mark = {"M-5 4.2V-4.2L0 0.8L5-4.2V4.2Z", "#9c2f2f", "#f08f85"},
    .make_projections = cycle_projections,
    .make = make_position_based,
};

constinit const StepperType steppers::kExplicitEuler = {
    .name = "explicit",
    .title = "Explicit",
    .meaning = "Forces give velocities, velocities give positions. Only stable in tiny substeps.",
    .settings = kExplicitSettings,
    .substeps_meaning = kZeroIsStable,
    .start = {kStableSubsteps, 1},
    .has_stability_bound = true,
    .usual_counts = kStable,
    .is_usual_for_springs = true,
    // Each level has four times the vertices and asks for four times the substeps: six runs of fine
    // cotton take half a minute at level 1 and about ten minutes at level 2.
    .finest_usual_level = 1,
    .substep_cost = [](const MethodOptions&) { return 1.0; },
    .mark = {"M0-5.6L5.6 0L0 5.6L-5.6 0Z", "#8e2a6b", "#ee92cd"},
    .make = make<StepperExplicit>,
};

constinit const StepperType steppers::kRk4 = {
    .name = "rk4",
    .title = "Runge-Kutta 4",
    .meaning = "Explicit, with four looks at the forces a substep. Very exact, and slow.",
    .settings = kRk4Settings,
    .substeps_meaning = kZeroIsStable,
    .start = {kStableSubsteps, 1},
    .has_stability_bound = true,
    .usual_counts = kStable,
    .finest_usual_level = 1,
    .substep_cost = [](const MethodOptions&) { return 4.0; },
    .mark = {"M-5-3.4H5L0 5.2Z", "#6a4fa3", "#bba6f0"},
    .make = make<StepperRk4>,
};

constinit const StepperType steppers::kNewton = {
    .name = "newton",
    .title = "Newton (exact, slow)",
    .meaning =
        "Backward Euler, solved to the last digit: all that is wrong is the length of its "
        "steps.",
    .settings = kNewtonSettings,
    .substeps_meaning = kDampedSubsteps,
    .tolerance = kNewtonTolerance,
    // A looser newton is no newton: its equations would be as wrong as those of one linearisation.
    .largest_tolerance = 1e-6,
    .takes_bend_friction = true,
    .prefers_factor = true,
    .solves_equations = true,
    .solves_whole_substeps = true,
    .usual_counts = kOneOrFour,
    .is_usual_for_membranes = true,
    // Some three rounds of ten solves with a factor that is kept.
    .substep_cost = [](const MethodOptions&) { return 200.0; },
    .mark = {"M-1.7-5H1.7V-1.7H5V1.7H1.7V5H-1.7V1.7H-5V-1.7H-1.7Z", "#1b2024", "#e9e6e0"},
    .make = make<StepperNewton>,
};

StepperTable standard_steppers() {
  static constexpr std::array<const StepperType*, 10> kTable = {
      &steppers::kImplicitEuler, &steppers::kImex,          &steppers::kProjective,
      &steppers::kXpbd,          &steppers::kPbd,           &steppers::kHpbd,
      &steppers::kMultigrid,     &steppers::kExplicitEuler, &steppers::kRk4,
      &steppers::kNewton};
  return kTable;
}

const MethodSetting* StepperType::setting(std::string_view key) const {
  for (const MethodSetting* known : settings)
    if (key == known->key) return known;
  return nullptr;
}

MethodOptions StepperType::usual_method() const {
  MethodOptions method;
  method.stepper = this;
  method.substeps = start.substeps;
  method.iterations = start.iterations;
  method.tolerance = tolerance;
  if (needs_factor || prefers_factor) method.solver = best_direct_solver();
  if (set_start != nullptr) set_start(method);
  return method;
}

const StepperType* find_stepper(StepperTable table, std::string_view name) {
  const auto at = std::find_if(table.begin(), table.end(),
                               [&](const StepperType* type) { return type->name == name; });
  return at == table.end() ? nullptr : *at;
}

std::vector<const MethodSetting*> all_settings(StepperTable table) {
  std::vector<const MethodSetting*> all;
  for (const MethodSetting& setting : kMethodSettings) all.push_back(&setting);
  for (const StepperType* type : table)
    for (const MethodSetting* setting : type->settings)
      if (std::find(all.begin(), all.end(), setting) == all.end()) all.push_back(setting);
  return all;
}

std::string stepper_names(StepperTable table) {
  std::string names;
  for (const StepperType* type : table)
    names += (names.empty() ? "" : ", ") + std::string(type->name);
  return names;
}

std::string stepper_help(StepperTable table) {
  constexpr std::size_t kIndent = 12;
  std::string help;
  for (const StepperType* type : table) {
    std::string line = "  " + std::string(type->name);
    line.resize(std::max(line.size() + 1, kIndent), ' ');
    help += line + type->meaning + "\n" + std::string(kIndent, ' ') + "reads";
    for (const MethodSetting* setting : type->settings)
      help += (setting == type->settings.front() ? " " : ", ") + std::string(setting->key);
    help += "\n";
  }
  return help;
}

std::unique_ptr<Stepper> make_stepper(ClothModel& model, const MethodOptions& options) {
  PLEAT_CHECK(options.stepper != nullptr, "a method names its stepper");
  const StepperType& type = *options.stepper;
  if (type.needs_factor && !is_direct(options.solver))
    throw InputError("/method/solver", std::string("expected eigen, cholmod or supernodal for ") +
                                           type.name + ", which needs a factor, got " +
                                           name(options.solver));
  if (model.bend_friction && !type.takes_bend_friction)
    throw InputError(
        "/method/stepper",
        std::string("expected implicit or newton for friction inside the fabric, whose moments "
                    "they find with the end of a step as no other does, got ") +
            type.name);
  if (type.needs_springs && !model.is_plain_spring_lattice())
    throw InputError("/model", std::string("expected springs with quadratic bending or none for ") +
                                   type.name + ", which works on nothing else");
  return type.make(model, options);
}

}  // namespace pleat
