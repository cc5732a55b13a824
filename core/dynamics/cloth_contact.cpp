#include "core/dynamics/cloth_contact.h"

#include "core/model/hanging_vertices.h"

namespace pleat {

ClothContact::ClothContact(ClothModel& model)
    : model_(model),
      pairs_(*model.self_contact, model.n_vertices()),
      movers_(model.masses, model.self_contact->hanging),
      response_(pairs_, movers_, model.self_contact->friction),
      guard_(pairs_, movers_) {
  begin_step();
}

void ClothContact::begin_step() {
  is_pressed_.assign(static_cast<std::size_t>(model_.n_vertices()), 0);
  is_pinned_.assign(static_cast<std::size_t>(model_.n_vertices()), 0);
  for (const Pin& pin : model_.pins) is_pinned_[pin.vertex] = 1;
  movers_.prescribe(is_pinned_);
}

// Solids keep vertices out that pairs have pushed into them.
bool ClothContact::meet_solids(double h) {
  if (!model_.contact) return false;
  bool any = false;
  for (int i = 0; i < model_.n_vertices(); ++i) {
    const VertexId v(i);
    if (ends_.col(i) == proposed_.col(i) || model_.hangs(v) || is_pinned_[v]) continue;
    Vec3 place = ends_.col(i);
    Vec3 velocity = (place - begins_.col(i)) / h;
    if (!model_.contact->resolve(v, begins_.col(i), place, velocity)) continue;
    if (place == ends_.col(i)) continue;
    movers_.move(v, place - ends_.col(i), ends_);
    any = true;
  }
  return any;
}

// Pairs push cloth into solids, and solids push it into cloth: each in turn.
void ClothContact::press(double h) {
  constexpr int kMaxRounds = 3;
  response_.start(begins_, ends_, h);
  for (int round = 0; round < kMaxRounds; ++round) {
    response_.push(ends_);
    if (!meet_solids(h)) break;
  }
  response_.finish(ends_, h);
  pushed_ = ends_;
  if (response_.part(ends_)) parted_ = ends_ - pushed_;
}

void ClothContact::note_pressed() {
  for (const WatchedPair& pair : pairs_.pairs()) {
    if (pair.force.isZero(0)) continue;
    for (const VertexId v : pair.sides.vertices)
      for (const VertexId carrier : movers_.carriers(v)) is_pressed_[carrier] = 1;
  }
  for (const Change& change : changes_) is_pressed_[change.vertex] = 1;
}

std::span<const ClothContact::Change> ClothContact::hold(double begin, double end) {
  const double h = end - begin;
  changes_.clear();
  if (!ends_.allFinite()) return changes_;  // the step has diverged, and will be told so
  place_between_parents(model_.hanging, begins_);
  place_between_parents(model_.hanging, ends_);
  proposed_ = ends_;
  parted_.setZero(3, ends_.cols());
  const bool is_listed = pairs_.cover(ends_, end) || pairs_.list(begins_, ends_, begin, end);
  if (is_listed) press(h);
  const HeldBack held =
      is_listed ? guard_.hold(begins_, ends_, begin, end) : guard_.hold_all(begins_, ends_);
  ++sums_.n_substeps;
  sums_.n_held += held.n_vertices;
  sums_.squared_loss += held.squared_loss;
  if (held.is_blocked) ++sums_.n_blocked;
  for (int i = 0; i < model_.n_vertices(); ++i)
    if (ends_.col(i) != proposed_.col(i))
      changes_.push_back({VertexId(i), (ends_.col(i) - proposed_.col(i) - parted_.col(i)) / h});
  note_pressed();
  return changes_;
}

std::size_t ClothContact::bytes() const {
  return pairs_.bytes() + static_cast<std::size_t>(3 * begins_.size()) * sizeof(double);
}

}  // namespace pleat
