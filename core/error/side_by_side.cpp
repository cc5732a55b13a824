#include "core/error/side_by_side.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/refinement/mesh_match.h"
#include "core/scene/tearing.h"

namespace pleat {
namespace {

constexpr double kRounding = 1e-9;  // share of a frame

bool is_whole(double ratio) { return std::abs(ratio - std::round(ratio)) < kRounding * ratio; }

std::unique_ptr<MovingCloth> moving_cloth(const Contestant& contestant) {
  if (contestant.adaptive)
    return std::make_unique<AdaptiveRun>(contestant.scene, *contestant.adaptive);
  return std::make_unique<Simulation>(contestant.scene);
}

Positions unpinned_columns(const ClothModel& model, const Positions& columns) {
  const std::vector<bool> is_pinned = model.pinned();
  Positions unpinned(3, columns.cols() - static_cast<Eigen::Index>(model.pins.size()));
  Eigen::Index next = 0;
  for (Eigen::Index v = 0; v < columns.cols(); ++v)
    if (!is_pinned[static_cast<std::size_t>(v)]) unpinned.col(next++) = columns.col(v);
  return unpinned;
}

/// RunComparison::errors of one time after another, averaged.
RunErrors mean_errors(const RunComparison& comparison, std::span<const Sample> run,
                      std::span<const Sample> reference) {
  RunErrors mean{0, 0, 0, 0, 0};
  const auto n = static_cast<double>(run.size());
  for (std::size_t s = 0; s < run.size(); ++s) {
    const RunErrors now = comparison.errors(run.subspan(s, 1), reference.subspan(s, 1));
    mean.position += now.position / n;
    mean.surface_rms += now.surface_rms / n;
    mean.surface_95 += now.surface_95 / n;
    mean.bend_distribution += now.bend_distribution / n;
    mean.bend_regions += now.bend_regions / n;
  }
  return mean;
}

SamplingError mean_sampling(const MeshSampling& sampling, std::span<const Sample> reference) {
  SamplingError squares;
  for (const Sample& sample : reference) {
    const SamplingError now = sampling.error(sample.positions);
    squares.distance += now.distance * now.distance;
    squares.normal_angle += now.normal_angle * now.normal_angle;
  }
  const auto n = static_cast<double>(reference.size());
  return {std::sqrt(squares.distance / n), std::sqrt(squares.normal_angle / n)};
}

}  // namespace

void FrameOptions::validate() const {
  if (!(frame_time > 0) || !(duration >= 2 * frame_time) || !is_whole(duration / frame_time))
    throw InputError("duration", "expected a whole number of frames, at least two, of " +
                                     std::to_string(frame_time) + " s, got " +
                                     std::to_string(duration) + " s");
  if (!(begin >= 0) || !(begin <= duration - 2 * frame_time))
    throw InputError(
        "begin of what is measured",
        "expected a time from 0 to two frames before the end, got " + std::to_string(begin) + " s");
  if (error_every < 1)
    throw InputError("frames between errors",
                     "expected a number of at least 1, got " + std::to_string(error_every));
}

void Insides::add(const Penetration& frame) {
  n_frames += frame.n_inside > 0 ? 1 : 0;
  most = std::max(most, frame.n_inside);
  deepest = std::max(deepest, frame.depth);
}

struct SideBySide::Run {
  Run(const Contestant& contestant, const FrameOptions& options)
      : entry(contestant),
        n_steps(steps_of_frame(contestant.scene.method.step, options.frame_time)),
        cloth(moving_cloth(contestant)),
        adaptive(dynamic_cast<AdaptiveRun*>(cloth.get())),
        steps(*cloth, TimedRun::Parts::timed) {
    const std::optional<RefinementPlan>& plan = contestant.scene.plan;
    if (!adaptive && plan && !plan->curvature_limits.empty()) {
      monitor.emplace(*cloth->mesh(), *plan);
      result.fit.emplace();
    }
  }

  void run_frame(bool is_timed);
  void observe_frame(bool is_compared, bool is_monitored, const QuadMesh* reference_mesh);
  void keep_sample(const QuadMesh* reference_mesh);
  ContestantResult summary() const;

  Contestant entry;
  std::int64_t n_steps;  // steps of a frame
  std::unique_ptr<MovingCloth> cloth;
  AdaptiveRun* adaptive;  // the cloth, or null
  TimedRun steps;
  std::optional<FitMonitor> monitor;
  std::vector<Sample> samples;
  double n_vertices_sum = 0;  // sum over frames
  ContestantResult result;
};

void SideBySide::Run::run_frame(bool is_timed) {
  const Stopwatch watch;
  if (adaptive != nullptr) {
    adaptive->adapt();
    if (is_timed) result.refinement_ms.push_back(1e3 * watch.elapsed());
  }
  steps.advance(n_steps);
  if (is_timed)
    result.frame_ms.push_back(1e3 * watch.elapsed());
  else
    steps.clear_costs();
}

void SideBySide::Run::keep_sample(const QuadMesh* reference_mesh) {
  const Positions& own = cloth->state().positions;
  Sample sample{cloth->time(), own, stretch(cloth->gauge(), own)};
  if (adaptive != nullptr) sample.positions = on_finer_mesh(own, *cloth->mesh(), *reference_mesh);
  samples.push_back(std::move(sample));
}

void SideBySide::Run::observe_frame(bool is_compared, bool is_monitored,
                                    const QuadMesh* reference_mesh) {
  const State& state = cloth->state();
  ++result.n_frames;
  n_vertices_sum += cloth->model().n_vertices();
  for (const GaugeEdge& edge : cloth->gauge())
    result.longest_edge = std::max(result.longest_edge, strain(edge, state.positions));
  if (const auto& contact = cloth->model().contact) {
    result.all_inside.add(contact->penetration(state.positions, cloth->time()));
    const Positions unpinned = unpinned_columns(cloth->model(), state.positions);
    result.unpinned_inside.add(contact->penetration(unpinned, cloth->time()));
  }
  if (monitor && is_monitored) {
    result.fit->last = monitor->add_frame(state.positions);
    result.fit->outside += result.fit->last.share;
  }
  if (is_compared) keep_sample(reference_mesh);
}

ContestantResult SideBySide::Run::summary() const {
  ContestantResult all = result;
  all.report = steps.report();
  const auto n_timed = static_cast<double>(std::max<std::size_t>(1, all.frame_ms.size()));
  all.parts_ms = steps.parts().mean_ms(n_timed);
  for (const Sample& sample : samples)
    all.rms_stretch += sample.stretch.rms / static_cast<double>(samples.size());
  if (all.fit && all.fit->last.n_frames > 0) all.fit->outside /= all.fit->last.n_frames;
  all.n_vertices = static_cast<int>(std::lround(n_vertices_sum / std::max(1, all.n_frames)));
  return all;
}

SideBySide::SideBySide(const std::vector<Contestant>& contestants, const FrameOptions& options)
    : options_(options) {
  PLEAT_CHECK(!contestants.empty(), "runs side by side are at least one");
  options_.validate();
  for (const Contestant& contestant : contestants) {
    expect_whole(contestant.scene);
    runs_.push_back(std::make_unique<Run>(contestant, options_));
  }
  for (const auto& run : runs_)
    if (run->cloth->mesh() == nullptr)
      throw InputError("/cloth", "expected a sheet or a garment, got cloth that is not of quads");
}

SideBySide::~SideBySide() = default;

void SideBySide::advance() {
  if (done()) return;
  ++frame_;
  const double time = frame_ * options_.frame_time;
  const double rounding = kRounding * options_.frame_time;
  const bool is_timed = time > options_.begin + rounding;
  const int n_left = options_.n_frames() - frame_;
  const bool is_compared = is_timed && n_left % options_.error_every == 0;
  for (const auto& run : runs_) {
    if (run->steps.has_ended()) continue;
    run->run_frame(is_timed);
    if (run->steps.has_ended()) continue;
    run->observe_frame(is_compared, time > options_.settled + rounding,
                       runs_.front()->cloth->mesh());
  }
}

std::vector<ContestantResult> SideBySide::results() const {
  PLEAT_CHECK(done(), "results are of whole runs");
  const Run& reference = *runs_.front();
  const QuadMesh& reference_mesh = *reference.cloth->mesh();
  const std::vector<Positions> rings = garment_rings(reference_mesh.triangle_mesh());
  std::vector<ContestantResult> results;
  for (const auto& run : runs_) {
    results.push_back(run->summary());
    if (run->samples.size() != reference.samples.size() || run->samples.empty()) continue;
    const Scene& scene = run->adaptive != nullptr ? reference.entry.scene : run->entry.scene;
    const RunComparison comparison(scene, reference.entry.scene);
    results.back().errors = mean_errors(comparison, run->samples, reference.samples);
    results.back().bend_over_time = comparison.bend_over_time(run->samples, reference.samples);
    const QuadMesh& mesh = run->adaptive != nullptr ? reference_mesh : *run->cloth->mesh();
    if (run->adaptive == nullptr)
      results.back().sampling =
          mean_sampling(MeshSampling(mesh, reference_mesh), reference.samples);
    FoldSpectrum folds(mesh.triangle_mesh(), rings);
    for (const Sample& sample : run->samples) folds.add(sample.positions);
    results.back().folds = folds.amplitudes();
  }
  return results;
}

}  // namespace pleat
