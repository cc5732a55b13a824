#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/fabric_file.h"
#include "core/scene/scene.h"

namespace pleat {

/// What the settings of a sweep are compared with.
enum class ReferenceKind {
  finest,  ///< the finest level of the sweep, `implicit` with a direct solver at a quarter of the
           ///< smallest step
  rigid_chain,  ///< chain_reference at the finest level
};

/// Every method at every level of one scene.
struct SweepPlan {
  Scene scene;                         ///< its own level and method do not count
  std::vector<int> levels;             ///< at least one
  std::vector<MethodOptions> methods;  ///< at least one
  double duration = 1;                 ///< [s], positive
  int n_repeats = 5;                   ///< timed runs of each setting, at least 1
  ReferenceKind reference = ReferenceKind::finest;

  int n_settings() const { return static_cast<int>(levels.size() * methods.size()); }
};

/// {"scene": a scene as in its file, "levels": [...], "methods": [as a scene's "method", ...],
/// "duration_s", "repeats", "reference": "finest"|"rigid_chain"}; all but scene may be missing:
/// then its own level and method, its duration, and the defaults above. Throws InputError with the
/// JSON pointer.
SweepPlan read_sweep_plan(std::string_view json_text, const FabricLibrary& fabrics);

std::string write_sweep_plan(const SweepPlan& plan);

/// Throws InputError at /duration_s when a run of the plan, its reference included, has more than
/// kMaxSteps steps.
void check_duration(const SweepPlan& plan);

/// The times at which a sweep of this duration [s] compares: ten, equally spaced, the last at its
/// end.
std::vector<double> sweep_sample_times(double duration);

/// The scene and method of ReferenceKind::finest. "Smallest step" is the smallest substep of the
/// methods that solve for a whole substep at once (implicit, projective), and the smallest step
/// where there is none of them.
Scene finest_scene(const SweepPlan& plan);

}  // namespace pleat
