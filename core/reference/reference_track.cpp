#include "core/reference/reference_track.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/run/carry_over.h"

namespace pleat {
namespace {

constexpr double kTimeTolerance = 1e-9;  // [s]: a sample at the very time

/// The reference's places for the vertices of a simulation: of those that both have, and between
/// them, where the reference is coarser, along its mesh lines.
Positions at_vertices_of(const Simulation& simulation, const Positions& reference) {
  const Eigen::Index n = simulation.model().n_vertices();
  if (reference.cols() >= n) return reference.leftCols(n);
  if (simulation.mesh() != nullptr) return carried_positions(reference, *simulation.mesh());
  return reference;
}

}  // namespace

ReferenceTrack::ReferenceTrack(Reference reference) : reference_(std::move(reference)) {
  if (reference_.samples.empty())
    throw InputError("", "expected a reference with samples, got none");
}

std::size_t ReferenceTrack::sample_after(double time) const {
  const auto& samples = reference_.samples;
  const auto place = std::find_if(samples.begin(), samples.end(), [&](const Sample& sample) {
    return sample.time >= time - kTimeTolerance;
  });
  return static_cast<std::size_t>(place - samples.begin());
}

std::optional<ReferenceTrack::Distance> ReferenceTrack::distance(const Simulation& simulation) {
  distances_.clear();
  if (simulation.is_disturbed()) return std::nullopt;
  const std::size_t after = sample_after(simulation.time());
  if (after == reference_.samples.size()) return std::nullopt;
  const Sample& next = reference_.samples[after];
  // The simulation's own start counts as the sample before the first.
  const double time_before = after > 0 ? reference_.samples[after - 1].time : 0;
  const double share =
      std::clamp((simulation.time() - time_before) / (next.time - time_before), 0.0, 1.0);
  const Positions end = at_vertices_of(simulation, next.positions);
  Positions expected = end;
  if (share < 1 - kTimeTolerance) {
    const Positions begin =
        after > 0 ? at_vertices_of(simulation, reference_.samples[after - 1].positions)
                  : Positions(simulation.rest_positions().leftCols(end.cols()));
    expected = (1 - share) * begin + share * end;
  }
  const Eigen::Index n = expected.cols();
  const Positions& x = simulation.state().positions;
  const Eigen::RowVectorXd squares = (x.leftCols(n) - expected).colwise().squaredNorm();
  const Eigen::VectorXd areas = simulation.rest_areas().head(n);
  distances_.assign(static_cast<std::size_t>(x.cols()), 0.0F);
  for (Eigen::Index i = 0; i < n; ++i)
    distances_[static_cast<std::size_t>(i)] = static_cast<float>(std::sqrt(squares[i]));
  return Distance{std::sqrt(squares.dot(areas) / areas.sum()), next.uncertainty};
}

}  // namespace pleat
