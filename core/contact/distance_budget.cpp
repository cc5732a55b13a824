#include "core/contact/distance_budget.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pleat {
namespace {

/// Bound of accumulated rounding, relative to the ways and places that are summed [1]: a million
/// substeps round to 1e-10 at worst. Larger would look at pairs too early.
constexpr double kRounding = 1e-9;

/// The norm of the difference of two rotations: 2 sin of half the angle between them.
double turn_between(const Pose& from, const Pose& to) {
  return (to.rotation - from.rotation).norm() / std::sqrt(2.0);
}

/// The farthest that any point of the hull moves from one pose to another [m], seen from a frame
/// that drifts.
/// |to q - from q| is convex in q, so greatest at the corners' balls.
double farthest_move(const DistanceBudget::Hull& hull, const Pose& from, const Pose& to,
                     const Vec3& drift) {
  double farthest = 0;
  for (const Vec3& corner : hull.corners)
    farthest = std::max(farthest, (to * corner - from * corner - drift).norm());
  return farthest + turn_between(from, to) * hull.radius;
}

Vec3 mean_place(const std::vector<DistanceBudget::Hull>& hulls, std::span<const Pose> poses) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < hulls.size(); ++k) sum += poses[k] * hulls[k].corners[0];
  return sum / static_cast<double>(hulls.size());
}

}  // namespace

DistanceBudget::DistanceBudget(std::vector<Hull> hulls)
    : hulls_(std::move(hulls)),
      poses_(hulls_.size()),
      moved_(hulls_.size(), 0),
      moves_(hulls_.size(), 0),
      spent_(hulls_.size(), 0) {}

// All is seen from a frame that drifts along with the solids' mean, so that nothing is spent while
// a body and its clothes walk on. Let F be the distance of a vertex from a solid at the begin of
// a substep, a the way it goes, m the most that any of the solid's points goes, and theta = |R - 1|
// for the solid's turn R. F changes by at most a + m from start to end, hence, with the sums of a
// and m, path and moved, since F was F',
//   F >= F' - (path - path') - (moved - moved').
// Within the substep, seen from the solid, the vertex goes by at most a + m + theta F: the solid's
// nearest point goes by m, and what is F away from it by theta F more. It does not meet the solid
// while F (1 - theta) > a + m, which holds if
//   F' + path' + moved' > path + a / (1 - theta) + moved + m / (1 - theta).
// The left side is the bound kept for the pair; spent is the sum of the last two terms.
void DistanceBudget::begin_substep(std::span<const Pose> begin, std::span<const Pose> end) {
  const Vec3 drift_before = drift_begin_;
  drift_begin_ = mean_place(hulls_, begin);
  drift_end_ = mean_place(hulls_, end);
  stretch_ = 1;
  for (std::size_t k = 0; k < hulls_.size(); ++k) {
    moved_[k] += farthest_move(hulls_[k], poses_[k], begin[k], drift_begin_ - drift_before);
    poses_[k] = begin[k];
    // A solid that turns by a radian or more in one substep rules nothing out.
    const double stretch = 1 / std::max(0.0, 1 - turn_between(begin[k], end[k]));
    moves_[k] = farthest_move(hulls_[k], begin[k], end[k], drift());
    spent_[k] = moved_[k] + stretch * moves_[k];
    stretch_ = std::max(stretch_, stretch);
  }
}

double DistanceBudget::bound(const Vertex& vertex, std::size_t solid, double distance) const {
  const double exact = distance + vertex.path + moved_[solid];
  const double size = std::abs(exact) + (vertex.place + drift_begin_).cwiseAbs().maxCoeff();
  return exact - kRounding * size;
}

void DistanceBudget::add_vertices(VertexId last) {
  vertices_.resize(static_cast<std::size_t>(last.value) + 1);
  bounds_.resize(vertices_.size() * hulls_.size(), -std::numeric_limits<double>::infinity());
}

}  // namespace pleat
