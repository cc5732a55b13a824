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

FaceCurvature::FaceCurvature(const QuadMesh& mesh)
    : vertices_(mesh), n_vertices_(mesh.n_vertices()) {
  for (const QuadFace& face : mesh.faces())
    if (face.active()) corners_.push_back(face.corners);
}

Eigen::VectorXd FaceCurvature::of(const PositionsView& positions) const {
  const Eigen::VectorXd at_vertices = vertices_.of(positions);
  Eigen::VectorXd curvature(n_faces());
  for (Eigen::Index f = 0; f < curvature.size(); ++f) {
    const auto& c = corners_[static_cast<std::size_t>(f)];
    curvature[f] =
        (at_vertices[c[0]] + at_vertices[c[1]] + at_vertices[c[2]] + at_vertices[c[3]]) / 4;
  }
  return curvature;
}

Eigen::VectorXd FaceCurvature::largest_around(const VectorView& values) const {
  Eigen::VectorXd at_vertices = Eigen::VectorXd::Zero(n_vertices_);
  for (Eigen::Index f = 0; f < values.size(); ++f)
    for (const VertexId v : corners_[static_cast<std::size_t>(f)])
      at_vertices[v] = std::max(at_vertices[v], values[f]);
  Eigen::VectorXd largest = values;
  for (Eigen::Index f = 0; f < values.size(); ++f)
    for (const VertexId v : corners_[static_cast<std::size_t>(f)])
      largest[f] = std::max(largest[f], at_vertices[v]);
  return largest;
}

ExampleEnvelope::ExampleEnvelope(const QuadMesh& mesh, const QuadMesh& fine)
    : sample_(mesh, fine), curvature_(mesh) {}

std::vector<double> ExampleEnvelope::limits() const {
  constexpr double kPart = 0.995;
  constexpr double kPerUnit = 100;
  PLEAT_CHECK(!seen_.empty(), "an envelope is of at least one frame");
  Eigen::VectorXd own(curvature_.n_faces());
  std::vector<double> of_face(seen_.size());
  for (Eigen::Index f = 0; f < own.size(); ++f) {
    for (std::size_t frame = 0; frame < seen_.size(); ++frame) of_face[frame] = seen_[frame][f];
    own[f] = std::ceil(kPerUnit * quantile(of_face, kPart)) / kPerUnit;
  }
  const Eigen::VectorXd around = curvature_.largest_around(curvature_.largest_around(own));
  return {around.begin(), around.end()};
}

FitMonitor::FitMonitor(const QuadMesh& mesh, const RefinementPlan& plan) : curvature_(mesh) {
  PLEAT_CHECK(base_fingerprint(mesh) == plan.base_mesh && mesh.n_vertices() == plan.n_vertices,
              "the mesh is the plan's");
  const auto n_limits = static_cast<Eigen::Index>(plan.curvature_limits.size());
  if (n_limits != curvature_.n_faces())
    throw InputError("/curvature_limits_per_m", "expected one limit for each of " +
                                                    std::to_string(curvature_.n_faces()) +
                                                    " faces, got " + std::to_string(n_limits));
  limits_ = Eigen::Map<const Eigen::VectorXd>(plan.curvature_limits.data(), n_limits);
}

FitReport FitMonitor::add_frame(const PositionsView& positions) {
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
