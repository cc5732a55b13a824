#pragma once

#include <vector>

#include "core/reference/reference.h"
#include "core/sweep/bench_row.h"

namespace pleat {

/// Puts stretch and errors into the row of a run that reached its last sample. Where the reference
/// is not known four times as well as the position, there is no error at all, and the row says so.
/// Against a reference that was kept at the vertices of a coarser mesh, position alone is compared.
void compare(const SampledRun& run, const Scene& reference_scene, const Reference& reference,
             BenchRow& row);

/// RMS distance of two series of samples of the scene at any two levels [m]; NaN where they are
/// not of the same times or closer than `uncertainty` [m] can tell.
double known_distance(const Scene& scene, const std::vector<Sample>& samples,
                      const std::vector<Sample>& reference, double uncertainty);

}  // namespace pleat
