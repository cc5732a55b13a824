#include "core/refinement/fit_monitor.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace pleat {
namespace {

/// The smallest value that so large a part of all does not exceed.
double quantile(std::vector<double> values, double part) {
  const auto n = static_cast<double>(values.size());
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::ceil(part * n)) - 1;
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

FaceCurvature::FaceCurvature(const QuadMesh& mesh) : vertices_(mesh) {
  for (const QuadFace& face : mesh.faces())
    if (face.active()) corners_.push_back(face.corners);
}

Eigen::VectorXd FaceCurvature::of(const Eigen::Ref<const Positions>& positions) const {
  const Eigen::VectorXd at_vertices = vertices_.of(positions);
  Eigen::VectorXd curvature(n_faces());
  for (Eigen::Index f = 0; f < curvature.size(); ++f) {
    const auto& c = corners_[static_cast<std::size_t>(f)];
    curvature[f] =
        (at_vertices[c[0]] + at_vertices[c[1]] + at_vertices[c[2]] + at_vertices[c[3]]) / 4;
  }
  return curvature;
}

std::vector<int> face_patterns(const QuadMesh& mesh, const RefinementPlan& plan) {
  PLEAT_CHECK(base_fingerprint(mesh) == plan.base_mesh && mesh.n_vertices() == plan.n_vertices,
              "the mesh is the plan's");
  Eigen::RowVectorXd base(static_cast<Eigen::Index>(plan.patterns.size()));
  for (Eigen::Index v = 0; v < base.size(); ++v)
    base[v] = plan.patterns[static_cast<std::size_t>(v)];
  const Eigen::RowVectorXd all = continued(base, mesh);
  std::vector<int> patterns;
  for (const QuadFace& face : mesh.faces()) {
    if (!face.active()) continue;
    double largest = 0;
    for (const VertexId v : face.corners) largest = std::max(largest, all[v]);
    patterns.push_back(static_cast<int>(std::lround(largest)));
  }
  return patterns;
}

ExampleEnvelope::ExampleEnvelope(const QuadMesh& mesh, const QuadMesh& fine,
                                 const RefinementPlan& plan)
    : sample_(mesh, fine),
      curvature_(mesh),
      patterns_(face_patterns(mesh, plan)),
      seen_(static_cast<std::size_t>(plan.n_patterns)) {}

void ExampleEnvelope::add(const Eigen::Ref<const Positions>& fine_positions) {
  const Eigen::VectorXd curvature = curvature_.of(sample_.of(fine_positions));
  for (std::size_t f = 0; f < patterns_.size(); ++f)
    seen_[static_cast<std::size_t>(patterns_[f])].push_back(
        curvature[static_cast<Eigen::Index>(f)]);
}

std::vector<double> ExampleEnvelope::limits() const {
  constexpr double kPart = 0.999;
  std::vector<double> limits;
  bool has_frames = false;
  for (const std::vector<double>& seen : seen_) {
    limits.push_back(seen.empty() ? 0 : quantile(seen, kPart));
    has_frames = has_frames || !seen.empty();
  }
  PLEAT_CHECK(has_frames, "an envelope is of at least one frame");
  return limits;
}

FitMonitor::FitMonitor(const QuadMesh& mesh, const RefinementPlan& plan) : curvature_(mesh) {
  if (plan.curvature_limits.size() != static_cast<std::size_t>(plan.n_patterns))
    throw InputError("/curvature_limits_per_m",
                     "expected one limit for each of " + std::to_string(plan.n_patterns) +
                         " patterns, got " + std::to_string(plan.curvature_limits.size()));
  const std::vector<int> patterns = face_patterns(mesh, plan);
  limits_.resize(curvature_.n_faces());
  for (Eigen::Index f = 0; f < limits_.size(); ++f)
    limits_[f] =
        plan.curvature_limits[static_cast<std::size_t>(patterns[static_cast<std::size_t>(f)])];
}

FitReport FitMonitor::look(const Eigen::Ref<const Positions>& positions) {
  const auto n_outside = (curvature_.of(positions).array() > limits_.array()).count();
  report_.share = static_cast<double>(n_outside) / static_cast<double>(limits_.size());
  report_.worst_share = std::max(report_.worst_share, report_.share);
  report_.n_in_a_row = report_.share > kLargestShare ? report_.n_in_a_row + 1 : 0;
  report_.fires = report_.n_in_a_row >= kFrames;
  if (report_.fires && !report_.first_fired) report_.first_fired = report_.n_frames;
  ++report_.n_frames;
  return report_;
}

}  // namespace pleat
