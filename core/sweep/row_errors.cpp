#include "core/sweep/row_errors.h"

#include <algorithm>

#include "core/base/formatted.h"
#include "core/error/error_norms.h"
#include "core/error/run_comparison.h"

namespace pleat {
namespace {

constexpr double kUncertaintyShare = 4;  // an error is known when it is so many times as large

std::string unconverged_sentence(double distance, double uncertainty) {
  return formatted(
      "no error: %.3g mm from the reference, which itself changes by %.3g mm "
      "when its step or mesh is halved",
      1e3 * distance, 1e3 * uncertainty);
}

/// The RMS over the sample times of the RMS, and the largest of the largest.
Stretch overall_stretch(const std::vector<Sample>& samples) {
  Stretch overall;
  std::vector<double> values;
  for (const Sample& sample : samples) {
    values.push_back(sample.stretch.rms);
    overall.largest = std::max(overall.largest, sample.stretch.largest);
  }
  overall.rms = root_mean_square(values);
  return overall;
}

/// True where the reference is known so much better than the error that it can tell it.
bool is_known(double error, double uncertainty) {
  return !(error < kUncertaintyShare * uncertainty);
}

/// True for a reference that was kept without the vertices of its finest meshes.
bool is_thinned(const Reference& reference, const Scene& scene) {
  return !scene.plan &&
         reference.samples.front().positions.cols() < scene.cloth->n_vertices(scene.level);
}

RunErrors errors_between(const SampledRun& run, const Scene& reference_scene,
                         const Reference& reference) {
  const Scene& scene = run.simulation().scene();
  const bool is_graded = scene.plan || reference_scene.plan;
  if (is_thinned(reference, reference_scene))
    return is_graded ? RunErrors{} : common_vertex_errors(scene, run.samples(), reference.samples);
  if (is_graded)
    return RunComparison(scene, reference_scene).errors(run.samples(), reference.samples);
  return RunComparison(scene, reference_scene.level).errors(run.samples(), reference.samples);
}

}  // namespace

double known_distance(const Scene& scene, const std::vector<Sample>& samples,
                      const std::vector<Sample>& reference, double uncertainty) {
  if (samples.empty() || samples.size() != reference.size()) return BenchRow::kUnknown;
  const double distance = root_mean_square(sample_distances(scene, samples, reference));
  return is_known(distance, uncertainty) ? distance : BenchRow::kUnknown;
}

void compare(const SampledRun& run, const Scene& reference_scene, const Reference& reference,
             BenchRow& row) {
  const Stretch own = overall_stretch(run.samples());
  row.rms_stretch = own.rms;
  row.largest_stretch = own.largest;
  if (reference.samples.size() != run.samples().size()) return;  // its numbers ended it
  const RunErrors errors = errors_between(run, reference_scene, reference);
  const double uncertainty = reference.label.uncertainty;
  if (!is_known(errors.position, uncertainty)) {
    row.reference.converged = false;
    if (row.message.empty()) row.message = unconverged_sentence(errors.position, uncertainty);
    return;
  }
  row.position_error = errors.position;
  row.position_error_95 = errors.position_95;
  const double diagonal = run.simulation().scene().cloth->rest_diagonal();
  if (diagonal > 0) row.position_error_percent = 100 * row.position_error / diagonal;
  row.surface_error = errors.surface_rms;
  row.surface_error_95 = errors.surface_95;
  row.bend_error = errors.bend_distribution;
  row.bend_error_of_regions = errors.bend_regions;
  const Stretch theirs = overall_stretch(reference.samples);
  row.rms_stretch_error = own.rms - theirs.rms;
  row.largest_stretch_error = own.largest - theirs.largest;
}

}  // namespace pleat
