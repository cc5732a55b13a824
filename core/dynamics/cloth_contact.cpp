#include "core/dynamics/cloth_contact.h"

#include <limits>
#include <optional>

#include "core/model/hanging_vertices.h"

namespace pleat {

namespace {

int n_in_bodies(const SelfContact& surfaces) {
  int n = 0;
  for (const BodySurface& body : surfaces.bodies) n += body.n_vertices();
  return n;
}

/// Masses of the cloth; nobody asks for those of bodies.
Eigen::VectorXd all_masses(const ClothModel& model) {
  Eigen::VectorXd masses =
      Eigen::VectorXd::Ones(model.n_vertices() + n_in_bodies(*model.self_contact));
  masses.head(model.n_vertices()) = model.masses;
  return masses;
}

}  // namespace

ClothContact::ClothContact(ClothModel& model)
    : model_(model),
      pairs_(*model.self_contact, model.n_vertices()),
      movers_(all_masses(model), model.self_contact->hanging),
      response_(pairs_, movers_),
      guard_(pairs_, movers_),
      bodies_time_(std::numeric_limits<double>::infinity()),
      begins_(3, model.n_vertices() + n_in_bodies(*model.self_contact)),
      ends_(begins_) {
  int end = model.n_vertices();
  for (const BodySurface& body : model.self_contact->bodies)
    bodies_.push_back({end += body.n_vertices(), std::nullopt});
  movers_.carry(model.n_vertices(), bodies_);
  begin_step();
}

void ClothContact::begin_step() {
  is_pressed_.assign(static_cast<std::size_t>(ends_.cols()), 0);
  is_pinned_.assign(static_cast<std::size_t>(ends_.cols()), 0);
  std::fill(is_pinned_.begin() + model_.n_vertices(), is_pinned_.end(), char{1});
  for (const Pin& pin : model_.pins) is_pinned_[pin.vertex] = 1;
  movers_.prescribe(is_pinned_);
}

// A body begins a substep where the last one has left it: cloth that could not give way has held
// it back. After a leap in time it is where its motion says.
void ClothContact::place_bodies(double begin, double end) {
  if (bodies_.empty()) return;
  const bool goes_on = std::abs(begin - bodies_time_) < (end - begin) / 2;
  bodies_time_ = end;
  int first = model_.n_vertices();
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const BodySurface& body = model_.self_contact->bodies[k];
    const Pose before = body.motion.pose(begin);
    const Pose after = body.motion.pose(end);
    const bool stands =
        before.rotation == after.rotation && before.translation == after.translation;
    bodies_[k].way = stands ? std::nullopt : std::optional(after * before.inverse());
    for (int i = 0; i < body.n_vertices(); ++i) {
      begins_.col(first + i) = goes_on ? Vec3(ends_.col(first + i)) : before * body.places.col(i);
      ends_.col(first + i) = after * body.places.col(i);
    }
    first = bodies_[k].end;
  }
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
  if (!ends().allFinite()) return changes_;  // the step has diverged, and will be told so
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
