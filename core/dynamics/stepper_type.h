#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "core/dynamics/method_options.h"
#include "core/mesh/quad_mesh.h"
#include "core/model/cloth_model.h"

namespace pleat {

class Projections;
class Stepper;
struct MethodSetting;
enum class SpringLaw;
struct LaneLayout;

/// Makes the constraint projections of a model, for substeps of h [s].
using MakeProjections = std::unique_ptr<Projections> (*)(const ClothModel& model,
                                                         const MethodOptions& options,
                                                         const LaneLayout& layout, SpringLaw law,
                                                         double h);

/// How often a stepper works in a step.
struct MethodCounts {
  int substeps = 1;  ///< or kStableSubsteps
  int iterations = 1;
};

/// How a stepper is drawn in charts.
struct StepperMark {
  const char* path;         ///< SVG path about the origin, about 10 px wide
  const char* colour;       ///< "#rrggbb", on a light ground
  const char* dark_colour;  ///< colour on a dark ground
};

/// One way to advance cloth. Whatever a scene, a sweep, a chart, the command or the page says of a
/// stepper comes from here.
struct StepperType {
  const char* name;     ///< word in scenes
  const char* title;    ///< name for people
  const char* meaning;  ///< sentence for people
  /// The settings that it reads; others are refused in a scene.
  std::span<const MethodSetting* const> settings;
  const char* substeps_meaning = "";    ///< effect of more substeps, a sentence
  const char* iterations_meaning = "";  ///< effect of more iterations, where it reads them
  /// Used where a scene says nothing.
  MethodCounts start = {};
  double tolerance = MethodOptions{}.tolerance;
  double largest_tolerance = 1;  ///< excluded when 1
  /// Sets what else it starts from; null: the defaults of MethodOptions.
  void (*set_start)(MethodOptions& method) = nullptr;

  bool has_stability_bound = false;    ///< takes kStableSubsteps, refuses too few
  bool needs_surface = false;          ///< makes coarser levels of the cloth's triangles
  bool needs_springs = false;          ///< works on springs with quadratic bending alone
  bool takes_bend_friction = false;    ///< asks it for each substep
  bool needs_factor = false;           ///< its solver is a direct one
  bool is_single_precision = false;    ///< single precision inside a step only
  bool prefers_factor = false;         ///< starts with a direct solver where a scene says nothing
  bool solves_equations = false;       ///< solves them to an end: a large residual is a fault
  bool solves_whole_substeps = false;  ///< solves one at once: its error is that of its substeps

  /// Worth comparing in a sweep, each about three times as dear as the one before.
  std::span<const MethodCounts> usual_counts;
  bool is_usual_for_springs = false;    ///< taken by sweeps that name no stepper
  bool is_usual_for_membranes = false;  ///< taken by sweeps of membranes that name no stepper
  int finest_usual_level = kMaxLevel;   ///< finest level on which the page's sweep takes it
  /// Rough cost of a substep per vertex, in units of what the forces of explicit cost.
  double (*substep_cost)(const MethodOptions& options);

  StepperMark mark;

  MakeProjections make_projections = nullptr;  ///< null unless it is position-based
  /// Throws InputError when the method cannot run on this model.
  std::unique_ptr<Stepper> (*make)(ClothModel& model, const MethodOptions& options);

  /// The setting of this key; null where it does not read it.
  const MethodSetting* setting(std::string_view key) const;
  bool reads(std::string_view key) const { return setting(key) != nullptr; }
  /// The options of a scene that names this stepper and nothing else.
  MethodOptions usual_method() const;
};

}  // namespace pleat
