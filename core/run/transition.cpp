#include "core/run/transition.h"

#include <algorithm>

namespace pleat {
namespace {

/// A smooth step from 1 to 0.
double share_at(double seconds) {
  const double s = std::clamp(seconds / kTransitionTime, 0.0, 1.0);
  return 1 - s * s * (3 - 2 * s);
}

double between(double own, double carried, double share) { return own + share * (carried - own); }

/// Options on the way from the cloth's own to the least of the old one's, which puts no vertex out
/// of a solid at the change.
ContactOptions between(ContactOptions own, const ContactOptions& carried, double share) {
  own.half_thickness = between(own.half_thickness, carried.half_thickness, share);
  const double least = carried.face_radii.size() > 0 ? carried.face_radii.minCoeff() : 0;
  for (double& radius : own.face_radii) radius = between(radius, least, share);
  return own;
}

}  // namespace

Transition::Transition(const MovingSheet& old, const MovingSheet& fresh)
    : own_springs_(fresh.model.springs),
      rest_lengths_(carried_rest_lengths(old, fresh)),
      drag_strength_(mass_ratio(old, fresh)) {
  if (old.model.air) drag_strength_ *= old.model.air->strength();
  if (fresh.model.contact) own_contact_ = fresh.model.contact->options();
  contact_ = old.model.contact ? old.model.contact->options() : own_contact_;
}

void Transition::apply(double seconds, ClothModel& model, Stepper& stepper) const {
  const double share = share_at(seconds);
  for (std::size_t s = 0; s < own_springs_.size(); ++s)
    model.springs[s].rest_length = between(own_springs_[s].rest_length, rest_lengths_[s], share);
  stepper.refresh_rest_lengths();
  if (model.air) model.air->set_strength(between(1, drag_strength_, share));
  if (model.contact) model.contact->set_options(between(own_contact_, contact_, share));
}

}  // namespace pleat
