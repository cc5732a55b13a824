#include "core/contact/pair_response.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/contact/closest_points.h"

namespace pleat {
namespace {

constexpr int kMaxSweeps = 20;
/// Change of a gap that is no longer worth a pass, in shares of the gap at rest.
constexpr double kTolerance = 1e-3;
/// Share of what a gap lacks that a substep gives back without velocity.
constexpr double kParting = 0.2;
/// Edges more parallel than this do not push: their ends do.
constexpr double kLeastAngle = 0.05;

bool pushes(const SurfacePair& pair, const Positions& x) {
  if (pair.kind == SurfacePair::Kind::vertex_face) return true;
  const Vec3 a = x.col(pair.vertices[1]) - x.col(pair.vertices[0]);
  const Vec3 b = x.col(pair.vertices[3]) - x.col(pair.vertices[2]);
  return a.cross(b).squaredNorm() > kLeastAngle * kLeastAngle * a.squaredNorm() * b.squaredNorm();
}

/// Least gap along a normal, of all vertices.
double least_gap(const SurfacePair& pair, const Vec3& n, const Positions& x) {
  double least = std::numeric_limits<double>::infinity();
  for (int a = 0; a < pair.n_first(); ++a)
    for (int b = pair.n_first(); b < 4; ++b)
      least = std::min(least, n.dot(x.col(pair.vertices[static_cast<std::size_t>(b)]) -
                                    x.col(pair.vertices[static_cast<std::size_t>(a)])));
  return least;
}

/// Second side's point less the first's.
Vec3 difference(const SurfacePair& pair, const std::array<double, 4>& weights, const Positions& x) {
  const Vec3 origin = x.col(pair.vertices[0]);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 1; k < 4; ++k) sum += weights[k] * (x.col(pair.vertices[k]) - origin);
  return sum;
}

}  // namespace

void PairResponse::collect(const Positions& begins, const Positions& ends) {
  contacts_.clear();
  const std::span<WatchedPair> pairs = pairs_.pairs();
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    WatchedPair& pair = pairs[p];
    const double old_push = std::exchange(pair.push, 0);
    if (old_push == 0 && least_gap(pair.sides, pair.normal, ends) >= pair.gap) continue;
    if (!pushes(pair.sides, begins)) continue;
    const SurfacePair& sides = pair.sides;
    const ClosestPoints closest =
        closest_points(pair_differences(sides, begins), sides.n_differences());
    const double gap = closest.difference.norm();
    if (!(gap > 0)) continue;
    Contact contact;
    contact.pair = static_cast<int>(p);
    contact.normal = closest.difference / gap;
    contact.weights = closest.weights;
    double softness = 0;
    for (int k = 0; k < 4; ++k) {
      const auto at = static_cast<std::size_t>(k);
      if (k < sides.n_first()) contact.weights[at] = -contact.weights[at];
      softness +=
          contact.weights[at] * contact.weights[at] * movers_.inverse_mass(sides.vertices[at]);
    }
    if (softness == 0) continue;
    contact.resistance = 1 / softness;
    contact.wanted = std::min(pair.gap, gap);
    contact.push = old_push;
    contacts_.push_back(contact);
  }
}

void PairResponse::pull(const Contact& contact, const Vec3& impulse, Positions& ends) {
  const SurfacePair& sides = pairs_.pairs()[static_cast<std::size_t>(contact.pair)].sides;
  for (std::size_t k = 0; k < 4; ++k) {
    const double factor = contact.weights[k] * movers_.inverse_mass(sides.vertices[k]);
    if (factor != 0) movers_.move(sides.vertices[k], factor * impulse, ends);
  }
}

double PairResponse::solve_once(Contact& contact, const Positions& begins, Positions& ends) {
  const WatchedPair& pair = pairs_.pairs()[static_cast<std::size_t>(contact.pair)];
  const Vec3 apart = difference(pair.sides, contact.weights, ends);
  const double lacking = contact.wanted - contact.normal.dot(apart);
  const double push = std::max(0.0, contact.push + contact.resistance * lacking);
  const double change = push - contact.push;
  contact.push = push;
  Vec3 impulse = change * contact.normal;
  if (friction_ > 0) {
    const Vec3 way = apart - difference(pair.sides, contact.weights, begins) + pair.slip;
    const Vec3 across = way - contact.normal.dot(way) * contact.normal;
    Vec3 rub = contact.rub - contact.resistance * across;
    const double most = friction_ * push;
    const double length = rub.norm();
    if (length > most) rub *= most / length;
    impulse += rub - contact.rub;
    contact.rub = rub;
  }
  if (impulse.squaredNorm() == 0) return 0;
  pull(contact, impulse, ends);
  return impulse.norm() / (contact.resistance * pair.gap);
}

void PairResponse::start(const Positions& begins, Positions& ends) {
  collect(begins, ends);
  for (const Contact& contact : contacts_)
    if (contact.push > 0) pull(contact, contact.push * contact.normal, ends);
}

void PairResponse::push(const Positions& begins, Positions& ends) {
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double most = 0;
    for (Contact& contact : contacts_) most = std::max(most, solve_once(contact, begins, ends));
    if (most < kTolerance) break;
  }
}

void PairResponse::finish(const Positions& begins, const Positions& ends) {
  n_active_ = 0;
  for (const Contact& contact : contacts_) {
    WatchedPair& pair = pairs_.pairs()[static_cast<std::size_t>(contact.pair)];
    pair.push = contact.push;
    if (contact.push > 0) ++n_active_;
    const Vec3 way = difference(pair.sides, contact.weights, ends) -
                     difference(pair.sides, contact.weights, begins) + pair.slip;
    const bool holds = contact.push > 0 && contact.rub.norm() < friction_ * contact.push;
    pair.slip = holds ? Vec3(way - contact.normal.dot(way) * contact.normal) : Vec3(0, 0, 0);
  }
}

bool PairResponse::part(Positions& ends) {
  bool any = false;
  for (const Contact& contact : contacts_) {
    const WatchedPair& pair = pairs_.pairs()[static_cast<std::size_t>(contact.pair)];
    if (contact.wanted >= pair.gap) continue;
    const double gap = contact.normal.dot(difference(pair.sides, contact.weights, ends));
    const double wanted = contact.wanted + kParting * (pair.gap - contact.wanted);
    if (gap >= wanted) continue;
    pull(contact, contact.resistance * (wanted - gap) * contact.normal, ends);
    any = true;
  }
  return any;
}

}  // namespace pleat
