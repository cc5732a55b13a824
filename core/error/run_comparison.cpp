#include "core/error/run_comparison.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/error/error_norms.h"
#include "core/error/surface_distance.h"
#include "core/run/carry_over.h"

namespace pleat {
namespace {

// Smoothed over a base edge a level finer would keep a gigabyte of neighbours for 16384 triangles.
constexpr int kMaxBendLevels = 3;

/// Mean length of the unrefined cloth's edges [m].
double base_edge(const Scene& scene) {
  const RestCloth base = rest_cloth(scene, 0);
  double sum = 0;
  int count = 0;
  for (const MeshEdge& edge : mesh_edges(base.mesh.triangles)) {
    sum += (base.mesh.rest_positions.col(edge.a) - base.mesh.rest_positions.col(edge.b)).norm();
    ++count;
  }
  return sum / count;
}

/// The longest side of the unrefined cloth's cells [m], beyond which no mesh of it has facets.
double largest_cell(const Scene& scene) {
  const RestCloth base = rest_cloth(scene, 0);
  if (!base.quads) return base_edge(scene);
  double largest = 0;
  for (const QuadFace& face : base.quads->faces())
    for (int k = 0; k < 4; ++k)
      largest = std::max(largest, (base.mesh.rest_positions.col(face.corners[k]) -
                                   base.mesh.rest_positions.col(face.corners[(k + 1) % 4]))
                                      .norm());
  return largest;
}

/// Edge middles of all refinements of a mesh from one level to another.
std::vector<std::array<VertexId, 2>> middles_between(const RestCloth& coarse, int levels) {
  std::vector<std::array<VertexId, 2>> middles;
  if (!coarse.quads && levels > 0) subdivided(coarse.mesh, levels, &middles);
  return middles;
}

void check_times(std::span<const Sample> run, std::span<const Sample> reference) {
  PLEAT_CHECK(!run.empty() && run.size() == reference.size(), "two runs have samples to compare");
  for (std::size_t s = 0; s < run.size(); ++s)
    PLEAT_CHECK(run[s].time == reference[s].time, "two runs are compared at the same times");
}

/// Rest areas of the vertices that both have.
Eigen::VectorXd common_areas(const Scene& scene, std::span<const Sample> run,
                             std::span<const Sample> reference) {
  check_times(run, reference);
  const Eigen::Index n = std::min(run[0].positions.cols(), reference[0].positions.cols());
  int level = 0;
  while (scene.cloth->n_vertices(level) < n) ++level;
  return rest_areas(rest_cloth(scene, level));
}

}  // namespace

RunComparison::RunComparison(const Scene& scene, int reference_level)
    : own_(rest_cloth(scene, scene.level)),
      reference_(rest_cloth(scene, reference_level)),
      own_is_finer_(scene.level > reference_level),
      areas_(own_is_finer_ ? rest_areas(reference_) : rest_areas(own_)) {
  const RestCloth& coarse = own_is_finer_ ? reference_ : own_;
  const RestCloth& fine = own_is_finer_ ? own_ : reference_;
  middles_ = middles_between(coarse, std::abs(scene.level - reference_level));
  const int levels = std::max(scene.level, reference_level);
  const bool has_curvature = !fine.mesh.warp_directions.empty() && levels <= kMaxBendLevels;
  if (has_curvature) bend_.emplace(fine.mesh, base_edge(scene));
}

RunComparison::RunComparison(const Scene& scene, const Scene& reference)
    : own_(rest_cloth(scene)),
      reference_(rest_cloth(reference)),
      own_is_finer_(false),
      areas_(rest_areas(reference_)) {
  PLEAT_CHECK(!own_.mesh.triangles.empty() && !reference_.mesh.triangles.empty(),
              "cloth with triangles");
  map_.emplace(own_.mesh, reference_.mesh.rest_positions);
  bend_.emplace(reference_.mesh, largest_cell(reference));
}

Positions RunComparison::on_finer_mesh(const Positions& positions, bool is_finer) const {
  if (map_ || is_finer || own_.mesh.n_vertices() == reference_.mesh.n_vertices()) return positions;
  const RestCloth& fine = own_is_finer_ ? own_ : reference_;
  if (fine.quads) return carried_positions(positions, *fine.quads);
  return subdivided_positions(positions, middles_);
}

RunErrors RunComparison::errors(std::span<const Sample> run,
                                std::span<const Sample> reference) const {
  check_times(run, reference);
  const auto n = static_cast<double>(run.size());
  RunErrors errors;
  std::vector<double> position_errors;
  std::vector<double> surface_errors;
  errors.position_95 = 0;
  if (bend_) errors.surface_95 = errors.bend_distribution = errors.bend_regions = 0;
  for (std::size_t s = 0; s < run.size(); ++s) {
    const Positions own = at_common_vertices(run[s].positions);
    position_errors.push_back(position_error(own, reference[s].positions, areas_));
    errors.position_95 += position_error_95(own, reference[s].positions, areas_) / n;
    if (!bend_) continue;
    const SurfaceError surface = surface_error(own_.mesh.triangles, run[s].positions,
                                               reference_.mesh.triangles, reference[s].positions);
    const BendError bend = bend_->error(on_finer_mesh(own, own_is_finer_),
                                        on_finer_mesh(reference[s].positions, !own_is_finer_));
    surface_errors.push_back(surface.rms);
    errors.surface_95 += surface.percentile_95 / n;
    errors.bend_distribution += bend.distribution / n;
    errors.bend_regions += bend.regions / n;
  }
  errors.position = root_mean_square(position_errors);
  if (bend_) errors.surface_rms = root_mean_square(surface_errors);
  return errors;
}

double RunComparison::bend_over_time(std::span<const Sample> run,
                                     std::span<const Sample> reference) const {
  check_times(run, reference);
  if (!bend_) return RunErrors::kUnknown;
  const Eigen::Index n = bend_->areas().size();
  const auto n_times = static_cast<Eigen::Index>(run.size());
  Eigen::VectorXd own(n * n_times);
  Eigen::VectorXd theirs(n * n_times);
  for (Eigen::Index s = 0; s < n_times; ++s) {
    const auto k = static_cast<std::size_t>(s);
    own.segment(s * n, n) =
        bend_->curvatures(on_finer_mesh(at_common_vertices(run[k].positions), own_is_finer_));
    theirs.segment(s * n, n) =
        bend_->curvatures(on_finer_mesh(reference[k].positions, !own_is_finer_));
  }
  return wasserstein_distance(own, theirs, bend_->areas().replicate(n_times, 1));
}

RunErrors common_vertex_errors(const Scene& scene, std::span<const Sample> run,
                               std::span<const Sample> reference) {
  const Eigen::VectorXd areas = common_areas(scene, run, reference);
  RunErrors errors;
  errors.position = root_mean_square(sample_distances(scene, run, reference));
  errors.position_95 = 0;
  for (std::size_t s = 0; s < run.size(); ++s)
    errors.position_95 += position_error_95(run[s].positions, reference[s].positions, areas);
  errors.position_95 /= static_cast<double>(run.size());
  return errors;
}

std::vector<double> sample_distances(const Scene& scene, std::span<const Sample> run,
                                     std::span<const Sample> reference) {
  const Eigen::VectorXd areas = common_areas(scene, run, reference);
  std::vector<double> distances;
  for (std::size_t s = 0; s < run.size(); ++s)
    distances.push_back(position_error(run[s].positions, reference[s].positions, areas));
  return distances;
}

}  // namespace pleat
