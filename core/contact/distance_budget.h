#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/base/pose.h"

namespace pleat {

/// Tells which moving solids a vertex may meet within a substep, from how far apart they were when
/// that was last looked at and how far both have moved since.
///
/// It errs to one side only: a solid that it rules out is not met. Vertices may jump, and times may
/// follow one another in any way. Source: docs/methods/contact.md.
class DistanceBudget {
 public:
  /// The solid lies in the hull of balls of `radius` [m] about the corners, and moves with its
  /// pose.
  struct Hull {
    std::array<Vec3, 4> corners;  ///< [m], where the pose is the identity
    double radius = 0;
  };

  DistanceBudget() = default;
  explicit DistanceBudget(std::vector<Hull> hulls);

  /// Poses of all solids at both ends of a substep.
  void begin_substep(std::span<const Pose> begin, std::span<const Pose> end);

  /// Way of the solids' mean in the substep [m].
  Vec3 drift() const { return drift_end_ - drift_begin_; }
  /// The furthest that any point of a solid goes in the substep, seen from that mean [m].
  double move(std::size_t solid) const { return moves_[solid]; }
  /// A vertex that is further from a solid than this times both of their ways does not meet it.
  double stretch() const { return stretch_; }

  /// Looks at every solid that a vertex may meet on its way in this substep.
  ///
  /// begin, end   of the way [m]
  /// distance_to  called as double(std::size_t solid); returns how far `begin` is from the solid's
  ///              surface [m] where the solid is at the start, or minus infinity
  /// Allocates for a vertex that comes for the first time.
  template <class DistanceTo>
  void visit_near(VertexId vertex, const Vec3& begin, const Vec3& end,
                  const DistanceTo& distance_to) {
    if (static_cast<std::size_t>(vertex.value) >= vertices_.size()) add_vertices(vertex);
    Vertex& known = vertices_[static_cast<std::size_t>(vertex.value)];
    const Vec3 adrift = begin - drift_begin_;
    known.path += (adrift - known.place).norm();
    known.place = adrift;
    const double spent = known.path + stretch_ * (end - drift_end_ - adrift).norm();
    double* bounds = &bounds_[static_cast<std::size_t>(vertex.value) * hulls_.size()];
    for (std::size_t solid = 0; solid < hulls_.size(); ++solid)
      if (!(bounds[solid] > spent + spent_[solid]))
        bounds[solid] = bound(known, solid, distance_to(solid));
  }

 private:
  struct Vertex {
    Vec3 place{0, 0, 0};  ///< its own at the start of the last substep, in the drifting frame [m]
    double path = 0;      ///< all the way there [m]
  };

  void add_vertices(VertexId last);
  /// The way that vertex and solid can go together before they meet, from time 0 on [m].
  double bound(const Vertex& vertex, std::size_t solid, double distance) const;

  std::vector<Hull> hulls_;
  std::vector<Pose> poses_;    // poses at the start of the substep
  std::vector<double> moved_;  // all that any of a solid's points has moved until then [m]
  std::vector<double> moves_;  // farthest move of a solid's points in the substep [m]
  std::vector<double> spent_;  // both, the latter stretched [m]
  double stretch_ = 1;         // factor on moves within the substep, for the turns of the solids
  Vec3 drift_begin_{0, 0, 0};  // mean place of the solids [m]
  Vec3 drift_end_{0, 0, 0};
  std::vector<Vertex> vertices_;
  std::vector<double> bounds_;  // one per vertex and solid, vertex by vertex [m]
};

}  // namespace pleat
