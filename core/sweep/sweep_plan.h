#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/dynamics/stepper_table.h"
#include "core/files/json_reader.h"
#include "core/scene/scene.h"

namespace pleat {

/// Reference for the settings of a sweep (sweep_reference.h makes it).
enum class ReferenceKind {
  /// Run of `newton` with the midpoint rule, its step checked. Where settings differ in level, so
  /// that the mesh is part of their error, on a mesh finer than any of them, the mesh checked too.
  converged,
  same_mesh,    ///< such a run on the setting's own mesh: what its steps alone do wrong
  rigid_chain,  ///< chain_reference at the finest level
  closed_form,  ///< closed_form_reference at the setting's own level
};

/// One way to compute the scene of a plan.
struct SweepSetting {
  Json changes;  ///< changes to the plan's scene: {pointer: value}
  int level;
  bool is_planned;  ///< true on the mesh of a plan, of level 0
  MethodOptions method;
  std::string family;  ///< name shared by settings that differ in level and method alone
  double n_vertices;   ///< number for an estimate of cost
};

/// Reads a scene from its parsed JSON. Throws InputError with the JSON pointer.
using SceneReader = std::function<Scene(const JsonReader& root)>;

constexpr std::size_t kMaxSettings = 10'000;

/// A scene and the settings in which it is computed.
struct SweepPlan {
  Json scene;  ///< scene of the file, but for its duration, which is the plan's
  SceneReader read;
  StepperTable steppers;               ///< steppers that its scenes may name
  std::vector<SweepSetting> settings;  ///< at least one
  std::string name;                    ///< the scene's
  double duration;                     ///< [s], positive
  int n_repeats = 5;                   ///< timed runs of each setting, at least 1
  ReferenceKind reference = ReferenceKind::converged;
  /// Step of the reference [s]; 0: a quarter of the smallest substep compared, at most 1/960 s.
  double reference_step = 0;
  /// Level of its mesh, at least the finest compared; without one that level, or the next finer
  /// where settings differ in level.
  std::optional<int> reference_level;

  /// The scene with a setting's changes.
  Scene scene_of(std::size_t setting) const;
};

/// Reads {"scene": as in its file, "grid": {pointer: [values], ...}, "settings": [{pointer: value,
/// ...}, ...], "duration_s", "repeats", "reference": "converged"|"same_mesh"|"rigid_chain"|
/// "closed_form", "reference_step_s", "reference_level"}. All but the scene may be missing; without
/// grid and settings it is computed as it is.
///
/// A grid is the product of its lists, the first pointer's values changing last; with settings,
/// each of them is taken at each point of the grid, before the next point. Pointers lead into the
/// scene (override_scene). Every setting has to be a scene that `read` takes. Throws InputError
/// with the plan's JSON pointer; the sentence names the scene's.
SweepPlan read_sweep_plan(const JsonReader& reader, const SceneReader& read,
                          StepperTable steppers = standard_steppers());

/// Plan with its settings in a list and every default written out.
Json json_sweep_plan(const SweepPlan& plan);

/// The times at which a sweep of this duration [s] compares: ten, equally spaced, the last at its
/// end.
std::vector<double> sweep_sample_times(double duration);

}  // namespace pleat
