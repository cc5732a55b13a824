#include "core/dynamics/first_contact.h"

namespace pleat {
namespace {

/// Share of a substep: contact that is sooner than this after its start has been there before.
constexpr double kLeastShare = 1e-12;

}  // namespace

void FirstContact::keep(const State& state, const ContactMemory& memory) {
  state_ = state;
  forces_ = memory.forces();
  if (model_.bend_friction) model_.bend_friction->keep(friction_);
}

void FirstContact::go_back(State& state, ContactMemory& memory) const {
  state = state_;
  memory.restart(forces_);
  if (model_.bend_friction) model_.bend_friction->restore(friction_, state.positions);
}

// Bisects the substep: each try starts from the same state, is shorter than those that touched and
// longer than those that did not, until one ends untouched and near enough. The rest of the
// substep, of length r, ends the fall by an impulse. Remembered as a force this acts over the h of
// the next substep, where r/h of it is the same impulse.
SolveReport FirstContact::advance(const Substep& substep, State& state, ContactMemory& memory,
                                  double time_end, double h) {
  keep(state, memory);
  SolveReport report = substep(state, time_end, h);
  if (!memory.is_touched() || report.ends_run()) return report;
  const double time_begin = time_end - h;
  double free = 0;
  double touched = h;
  bool is_near = false;
  while (!is_near && touched - free > kLeastShare * h) {
    const double part = free + (touched - free) / 2;
    go_back(state, memory);
    report = substep(state, time_begin + part, part);
    if (report.ends_run()) return report;
    (memory.is_touched() ? touched : free) = part;
    is_near = !memory.is_touched() &&
              model_.contact->least_gap(state.positions, memory.exempt()) <= within_;
  }
  time_ = time_begin + free;
  if (is_near) {
    report.add(substep(state, time_end, h - free));
    memory.forces() *= (h - free) / h;
    return report;
  }
  go_back(state, memory);
  return substep(state, time_end, h);
}

}  // namespace pleat
