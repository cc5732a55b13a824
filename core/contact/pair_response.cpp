#include "core/contact/pair_response.h"

#include <algorithm>
#include <cmath>

namespace pleat {
namespace {

constexpr int kMaxSweeps = 20;
/// Change of a gap that is no longer worth a pass, in shares of the gap at rest.
constexpr double kTolerance = 1e-3;
/// Share of what a gap lacks that a substep gives back without velocity.
constexpr double kParting = 0.2;

Vec3 across(const Vec3& vector, const Vec3& normal) { return vector - normal.dot(vector) * normal; }

}  // namespace

Vec3 PairResponse::Pressing::difference(const Positions& places) const {
  // Weights sum to zero: differences from one vertex lose no digits far off.
  const Vec3 origin = places.col(vertices[0]);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 1; k < 4; ++k) sum += weights[k] * (places.col(vertices[k]) - origin);
  return sum;
}

void PairResponse::Pressing::set_rub(const Vec3& impulse) {
  const double most = friction * push;
  const double squared = impulse.squaredNorm();
  slips = !(squared < most * most);
  rub = squared > most * most ? Vec3(most / std::sqrt(squared) * impulse) : impulse;
}

PairResponse::Pressing PairResponse::pressing(const WatchedPair& pair, const PairContact& contact,
                                              const Positions& begins, double h) const {
  Pressing found(contact);
  found.vertices = pair.sides.vertices;
  double softness = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    found.softnesses[k] = contact.weights[k] * movers_.inverse_mass(found.vertices[k]);
    softness += contact.weights[k] * found.softnesses[k];
  }
  found.resistance = softness > 0 ? 1 / softness : 0;
  found.rest_gap = pair.gap;
  found.friction = pairs_.friction(pair);
  found.begin = found.difference(begins) - pair.slip;
  take_force(pair, h, found);
  return found;
}

// The normal has turned since: what would pull now is none, and friction keeps its bound.
void PairResponse::take_force(const WatchedPair& pair, double h, Pressing& contact) const {
  contact.push = std::max(0.0, h * h * contact.normal.dot(pair.force));
  contact.set_rub(h * h * across(pair.force, contact.normal));
}

void PairResponse::collect(const Positions& begins, const Positions& ends, double h) {
  contacts_.clear();
  const std::span<WatchedPair> pairs = pairs_.pairs();
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const WatchedPair& pair = pairs[p];
    const bool pressed = pair.is_solved || !pair.force.isZero(0);
    if (!pressed && least_gap(pair.sides, pair.normal, ends) >= pair.gap) continue;
    const auto found = pair_contact(pair, static_cast<int>(p), begins);
    if (!found) continue;
    const Pressing contact = pressing(pair, *found, begins, h);
    if (contact.resistance > 0) contacts_.push_back(contact);
  }
}

void PairResponse::pull(const Pressing& contact, const Vec3& impulse, Positions& ends) const {
  for (std::size_t k = 0; k < 4; ++k)
    if (contact.softnesses[k] != 0)
      movers_.shift(contact.vertices[k], contact.softnesses[k] * impulse, ends);
}

double PairResponse::solve_once(Pressing& contact, Positions& ends) const {
  const Vec3 apart = contact.difference(ends);
  const double lacking = contact.wanted - contact.normal.dot(apart);
  const double push = std::max(0.0, contact.push + contact.resistance * lacking);
  if (push == 0 && contact.push == 0) return 0;
  Vec3 impulse = (push - contact.push) * contact.normal;
  contact.push = push;
  if (contact.friction > 0) {
    const Vec3 before = contact.rub;
    const Vec3 way = across(apart - contact.begin, contact.normal);
    contact.set_rub(before - contact.resistance * way);
    impulse += contact.rub - before;
  }
  if (impulse.isZero(0)) return 0;
  pull(contact, impulse, ends);
  return impulse.norm() / (contact.resistance * contact.rest_gap);
}

void PairResponse::start(const Positions& begins, Positions& ends, double h) {
  collect(begins, ends, h);
  for (const Pressing& contact : contacts_) {
    const WatchedPair& pair = pairs_.pairs()[static_cast<std::size_t>(contact.pair)];
    // A force that a solve knew is in the ends, as all threads answered to it.
    if (!pair.is_solved && contact.push > 0)
      pull(contact, contact.push * contact.normal + contact.rub, ends);
  }
}

// There and back: what one end of a pile gives the other feels in the same sweep or the next.
void PairResponse::push(Positions& ends) {
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double most = 0;
    for (std::size_t k = 0; k < contacts_.size(); ++k)
      most = std::max(most,
                      solve_once(contacts_[sweep % 2 == 0 ? k : contacts_.size() - 1 - k], ends));
    if (most < kTolerance) break;
  }
}

void PairResponse::finish(const Positions& ends, double h) {
  n_active_ = 0;
  for (WatchedPair& pair : pairs_.pairs()) {
    if (!pair.is_solved) pair.force_before = pair.force.norm();
    pair.force.setZero();
    pair.is_solved = pair.sticks = false;
    pair.slip.setZero();
  }
  for (const Pressing& contact : contacts_) {
    if (contact.push == 0) continue;
    ++n_active_;
    WatchedPair& pair = pairs_.pairs()[static_cast<std::size_t>(contact.pair)];
    pair.force = (contact.push * contact.normal + contact.rub) / (h * h);
    pair.sticks = !contact.slips;
    if (pair.sticks) pair.slip = across(contact.difference(ends) - contact.begin, contact.normal);
  }
}

bool PairResponse::part(Positions& ends) {
  bool any = false;
  for (const Pressing& contact : contacts_) {
    if (contact.wanted >= contact.rest_gap) continue;
    const double gap = contact.normal.dot(contact.difference(ends));
    const double wanted = contact.wanted + kParting * (contact.rest_gap - contact.wanted);
    if (gap >= wanted) continue;
    pull(contact, contact.resistance * (wanted - gap) * contact.normal, ends);
    any = true;
  }
  return any;
}

}  // namespace pleat
