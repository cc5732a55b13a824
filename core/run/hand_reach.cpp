#include "core/run/hand_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pleat {

HandReach::HandReach(const Eigen::VectorXd& ways, std::span<const Pin> pins,
                     std::vector<Thread> threads, const Grip& grip, double stretch)
    : threads_(std::move(threads)) {
  for (const Pin& pin : pins) {
    const double length = ways[pin.vertex];
    if (length == 0 || !std::isfinite(length)) continue;
    const double pulled = length + stretch * std::max(length - grip.radius, 0.0);
    const double present = (pin.position(grip.time) - grip.place).norm();
    tethers_.push_back({pin, length, std::max(pulled, present)});
  }
}

// Vertices beside the hand go on as they move, as they will in the step: a hand may get faster than
// a tenth of a thread a step, and may stay where it is while cloth swings about it.
void HandReach::place_balls(const State& state, VertexId grabbed, double time_end, double h) {
  const Vec3 begin = state.positions.col(grabbed);
  balls_.clear();
  for (const Tether& tether : tethers_)
    balls_.push_back({tether.pin.position(time_end), tether.longest});
  for (const Thread& thread : threads_) {
    const Vec3 away = state.positions.col(thread.beside) - state.positions.col(thread.held);
    const Vec3 next = away + h * state.velocities.col(thread.beside);
    const bool is_taut = away.norm() > thread.longest;
    const double radius = is_taut ? thread.longest : std::max(thread.longest, next.norm());
    balls_.push_back({begin + next, radius});
  }
  pushes_.resize(balls_.size(), Vec3::Zero());
}

// Dykstra's projections: a ball gives back what it pushed in the sweep before, and then pushes
// anew. They end at the nearest place in all balls, where projections alone end at any. Many pins
// in a row take hundreds of sweeps; pushes are kept from step to step.
Vec3 HandReach::nearest(const Vec3& target) {
  constexpr int kSweeps = 20;
  Vec3 place = target;
  for (const Vec3& push : pushes_) place += push;
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      const auto& [centre, radius] = balls_[i];
      const Vec3 from = place - pushes_[i] - centre;
      const double distance = from.norm();
      const double beyond = distance > radius ? 1 - radius / distance : 0;
      pushes_[i] = -beyond * from;
      place = centre + from + pushes_[i];
    }
  return place;
}

/// Share of a way from a place in a ball that does not leave it.
double HandReach::share_in(const Ball& ball, const Vec3& begin, const Vec3& way) {
  const Vec3 from = begin - ball.centre;
  const double a = way.squaredNorm();
  const double b = from.dot(way);
  const double c = from.squaredNorm() - ball.radius * ball.radius;
  if (c > 0 || a == 0) return 1;
  return (std::sqrt(b * b - a * c) - b) / a;
}

Vec3 HandReach::move(const State& state, VertexId grabbed, const Vec3& target, double time_end,
                     double h) {
  place_balls(state, grabbed, time_end, h);
  const Vec3 begin = state.positions.col(grabbed);
  const Vec3 way = nearest(target) - begin;
  double share = std::min(1.0, kHandSpeed * h / std::max(way.norm(), kHandSpeed * h));
  for (const Ball& ball : balls_) share = std::min(share, share_in(ball, begin, way));
  return share * way;
}

double HandReach::asked(const Vec3& target, double time) const {
  double most = 0;
  for (const Tether& tether : tethers_)
    most = std::max(most, (target - tether.pin.position(time)).norm() / tether.length);
  return most;
}

Eigen::VectorXd ways_along(std::span<const GaugeEdge> edges, VertexId from, int n_vertices) {
  Eigen::VectorXd ways =
      Eigen::VectorXd::Constant(n_vertices, std::numeric_limits<double>::infinity());
  ways[from] = 0;
  bool is_shorter = true;
  const auto pass = [&](const GaugeEdge& edge) {
    const double over_a = ways[edge.a] + edge.rest_length;
    const double over_b = ways[edge.b] + edge.rest_length;
    if (over_a >= ways[edge.b] && over_b >= ways[edge.a]) return;
    ways[edge.a] = std::min(ways[edge.a], over_b);
    ways[edge.b] = std::min(ways[edge.b], over_a);
    is_shorter = true;
  };
  while (is_shorter) {
    is_shorter = false;
    std::for_each(edges.begin(), edges.end(), pass);
    std::for_each(edges.rbegin(), edges.rend(), pass);
  }
  return ways;
}

}  // namespace pleat
