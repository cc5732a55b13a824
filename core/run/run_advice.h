#pragma once

#include <vector>

#include "core/run/run_warning.h"
#include "core/scene/scene.h"

namespace pleat {

/// Settings that may mend what a run shows, each by itself, the best one first. What they rest on
/// and how often they help is in docs/methods/plausibility.md.
///
/// excess  worst value over what the scene explains, at least 1
std::vector<SettingHint> hints_for(RunWarning::Kind kind, double excess, const Scene& scene);

}  // namespace pleat
