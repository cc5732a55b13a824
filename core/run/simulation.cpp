#include "core/run/simulation.h"

#include <cmath>
#include <utility>

#include "core/base/check.h"
#include "core/contact/body_start.h"
#include "core/dynamics/explicit/stability_bound.h"
#include "core/dynamics/stepper_table.h"
#include "core/refinement/mesh_match.h"
#include "core/run/content_id.h"
#include "core/scene/tearing.h"

namespace pleat {

Simulation::Simulation(const Scene& scene)
    : scene_(scene),
      cloth_(rest_cloth(scene)),
      model_(scene_model(scene, cloth_)),
      gauge_(gauge_edges(cloth_)) {
  start();
  if (scene.start) expect_outside_of_solids();
  expect_outside_of_bodies();
}

/// A start is of cloth that solids have held; sampled on a coarser mesh it may be a little inside.
void Simulation::expect_outside_of_solids() const {
  constexpr double kDeepest = 2e-3;  // [m]
  if (!model_.contact) return;
  const Penetration found = model_.contact->penetration(state_.positions, 0);
  if (found.depth <= kDeepest) return;
  throw InputError("/start", "expected cloth outside of solids, got vertex " +
                                 std::to_string(found.deepest.value) + " " +
                                 std::to_string(std::lround(1e3 * found.depth)) +
                                 " mm inside of one");
}

/// Bodies are met by their surfaces, which have to have the cloth on their outside.
void Simulation::expect_outside_of_bodies() const {
  if (!model_.meets_bodies()) return;
  const std::string found = cloth_in_bodies(*model_.self_contact, state_.positions, 0);
  if (found.empty()) return;
  throw InputError(scene_.start ? "/start" : "/world/colliders",
                   "expected cloth that starts off boxes and meshes, got " + found);
}

/// A new stepper, so that nothing of an earlier run (a solver's first guess, say) is left.
void Simulation::start() {
  state_ = scene_state(cloth_);
  if (start_positions_) state_.positions = *start_positions_;
  time_begin_ = 0;
  n_steps_ = 0;
  was_led_astray_ = false;
  ended_ = {};
  for (const Pin& pin : model_.pins) state_.positions.col(pin.vertex) = pin.position(0);
  if (model_.bend_friction) model_.bend_friction->restart(state_.positions);
  stepper_ = make_stepper(model_, scene_.method);
  stepper_->observe(observer_);
}

void Simulation::observe(PartObserver* observer) {
  observer_ = observer;
  stepper_->observe(observer);
}

void Simulation::reset() {
  release_grab();
  end_transition();
  make_whole();
  start();
}

/// Pins stay, and what the contact pass has counted.
void Simulation::take_cloth(RestCloth cloth) {
  stepper_.reset();  // it refers to the model
  cloth_ = std::move(cloth);
  std::vector<Pin> pins = std::move(model_.pins);
  std::optional<ContactPass> contact = std::move(model_.contact);
  model_ = scene_model(scene_, cloth_);
  model_.pins = std::move(pins);
  if (contact) contact->set_options(model_.contact->options());
  model_.contact = std::move(contact);
  gauge_ = gauge_edges(cloth_);
  ++topology_;
}

void Simulation::make_whole() {
  if (tear_origins_.empty()) return;
  tear_origins_.clear();
  take_cloth(rest_cloth(scene_));
}

/// Tears the cloth. Each part of a vertex goes on with the vertex's velocity and shares its mass
/// and what held it against solids: momentum and forces add up to what they were.
void Simulation::tear() {
  const Tearing& tearing = *scene_.model.tearing;
  std::optional<TornCloth> torn = tearing.torn(cloth_, gauge_, state_.positions, model_.pins);
  if (!torn) return;
  const Positions forces = stepper_->contact_forces();
  const Eigen::VectorXd masses = model_.masses;
  const std::optional<BendFriction> friction = model_.bend_friction;
  take_cloth(std::move(torn->cloth));
  state_.positions = tearing.split(state_.positions, torn->origins);
  state_.velocities = tearing.split(state_.velocities, torn->origins);
  if (friction) model_.bend_friction->take_moments(*friction, state_.positions);
  stepper_ = make_stepper(model_, scene_.method);
  stepper_->observe(observer_);
  if (forces.cols() > 0)
    stepper_->start_from_contact_forces(
        tearing.shared(forces, masses, model_.masses, torn->origins));
  tear_origins_.insert(tear_origins_.end(), torn->origins.begin(), torn->origins.end());
}

void Simulation::start_from(const PositionsView& positions) {
  const auto n_vertices = static_cast<Eigen::Index>(model_.masses.size()) -
                          static_cast<Eigen::Index>(tear_origins_.size());
  if (positions.cols() != n_vertices || !positions.allFinite())
    throw InputError("", "expected a finite place for each of " + std::to_string(n_vertices) +
                             " vertices, got " + std::to_string(positions.cols()) + " places");
  release_grab();
  end_transition();
  make_whole();
  start_positions_ = positions;
  for (Pin& pin : model_.pins) pin.place = positions.col(pin.vertex);
  start();
  expect_outside_of_bodies();
}

Positions Simulation::contact_accelerations() const {
  Positions accelerations = stepper_->contact_forces();
  for (Eigen::Index v = 0; v < accelerations.cols(); ++v)
    if (model_.masses[v] > 0) accelerations.col(v) /= model_.masses[v];
  return accelerations;
}

void Simulation::go_on_from(const State& state, double time,
                            const Positions& contact_accelerations) {
  reset();
  const Eigen::Index n_vertices = model_.masses.size();
  for (const Positions* columns : {&state.positions, &state.velocities})
    if (columns->cols() != n_vertices || !columns->allFinite())
      throw InputError("", "expected finite places and velocities of " +
                               std::to_string(n_vertices) + " vertices, got " +
                               std::to_string(columns->cols()) +
                               (columns->allFinite() ? "" : ", not all finite"));
  state_ = state;
  straighten(model_.hanging, state_.positions);
  straighten(model_.hanging, state_.velocities);
  for (const Pin& pin : model_.pins) state_.positions.col(pin.vertex) = pin.position(time);
  if (model_.bend_friction) model_.bend_friction->restart(state_.positions);
  if (contact_accelerations.cols() > 0)
    stepper_->start_from_contact_forces(contact_accelerations * model_.masses.asDiagonal());
  time_begin_ = time;
  was_led_astray_ = true;
}

std::optional<double> Simulation::stability_bound() const {
  if (!scene_.method.stepper->has_stability_bound) return std::nullopt;
  return pleat::stability_bound(model_, scene_.method);
}

SolveReport Simulation::step() {
  if (ended_.ends_run()) return ended_;
  if (transition_) {
    const double since = time() - time_begin_;
    if (since < kTransitionTime)
      transition_->apply(since, model_, *stepper_);
    else
      end_transition();
  }
  if (scene_.model.tearing && !transition_) tear();
  if (holds_cloth()) place_grab_pins();
  ended_ = stepper_->advance(state_, time());
  if (!ended_.ends_run()) ++n_steps_;
  return ended_;
}

void Simulation::carry_over(const Simulation& old) {
  const auto* own = scene_.cloth.as<SheetCloth>();
  const auto* olds = old.scene_.cloth.as<SheetCloth>();
  PLEAT_CHECK(own && olds && own->shape.columns == olds->shape.columns &&
                  own->shape.rows == olds->shape.rows,
              "motion is carried over between refinements of one sheet");
  PLEAT_CHECK(old.tear_origins().empty(), "what is torn is not carried over");
  end_transition();
  const MovingSheet from{*old.cloth_.quads, old.model_, old.state_};
  state_ = carried_state(from, *cloth_.quads);
  if (model_.bend_friction) {
    model_.bend_friction->restart(state_.positions);
    if (old.model_.bend_friction)
      model_.bend_friction->take_moments(*old.model_.bend_friction, state_.positions);
  }
  const MovingSheet to{*cloth_.quads, model_, state_};
  transition_.emplace(from, to);
  stepper_->start_from_contact_forces(carried_forces(old.stepper_->contact_forces(), from, to));
  time_begin_ = old.time();
  n_steps_ = 0;
  was_led_astray_ = old.is_disturbed() || content_id(old.scene_) != content_id(scene_);
  if (old.grab_ && old.grab_->vertex < model_.n_vertices()) {
    grab(old.grab_->vertex);
    move_grab(old.grab_->target);
  }
}

void Simulation::end_transition() {
  if (!transition_) return;
  transition_->apply(kTransitionTime, model_, *stepper_);
  transition_.reset();
}

// A vertex that hangs goes where its parents go, and so with the hand only where it has both. A
// hand does not stretch what it holds, so that all of it stays where a pin holds its middle.
std::vector<bool> Simulation::in_hand_at(VertexId vertex, double radius) const {
  const std::vector<bool> pinned = model_.pinned();
  const Positions& rest = rest_positions();
  std::vector<bool> in_hand(pinned.size(), false);
  if (pinned[vertex]) return in_hand;
  for (int i = 0; i < model_.n_vertices(); ++i)
    in_hand[static_cast<std::size_t>(i)] = !pinned[static_cast<std::size_t>(i)] &&
                                           !model_.hangs(VertexId(i)) &&
                                           (rest.col(i) - rest.col(vertex)).norm() <= radius;
  for (const HangingVertex& h : model_.hanging)
    for (const VertexId parent : h.parents)
      if (h.vertex == vertex) in_hand[parent] = !pinned[parent];
  for (const HangingVertex& h : model_.hanging)
    in_hand[h.vertex] = in_hand[h.parents[0]] && in_hand[h.parents[1]];
  return in_hand;
}

void Simulation::grab(VertexId vertex) {
  PLEAT_CHECK(vertex >= 0 && vertex < model_.n_vertices(), "a grabbed vertex exists");
  release_grab();
  was_led_astray_ = true;
  const double radius =
      scene_.cloth->is_surface() ? kHandRadius * scene_.cloth->rest_diagonal() : 0;
  const std::vector<bool> in_hand = in_hand_at(vertex, radius);
  const Vec3 begin = state_.positions.col(vertex);
  grab_ = Grab{vertex, model_.pins.size(), begin, reach_of(vertex, radius, in_hand)};
  for (int i = 0; i < model_.n_vertices(); ++i) {
    if (in_hand[static_cast<std::size_t>(i)] && !model_.hangs(VertexId(i)))
      model_.pins.push_back({VertexId(i), state_.positions.col(i), {}});
  }
  stepper_->refresh();
}

// The way between two vertices is their distance on a flat sheet, and along edges of triangles on
// other surfaces: straight from one side of a skirt to the other there is no cloth. A hand as wide
// as what it holds bears all of its pull on that width.
HandReach Simulation::reach_of(VertexId vertex, double radius,
                               const std::vector<bool>& in_hand) const {
  const Vec3 place = state_.positions.col(vertex);
  const HandReach::Grip grip{place, time(), radius};
  if (!scene_.cloth->is_surface() || scene_.model.tearing) return {{}, {}, {}, grip, 0};
  const Positions& rest = rest_positions();
  const Eigen::VectorXd ways =
      scene_.cloth.as<SheetCloth>()
          ? Eigen::VectorXd((rest.colwise() - rest.col(vertex)).colwise().norm())
          : ways_along(gauge_edges(cloth_.mesh), vertex, model_.n_vertices());
  std::vector<HandReach::Thread> threads;
  for (const GaugeEdge& edge : gauge_) {
    if (in_hand[edge.a] == in_hand[edge.b]) continue;
    const bool holds_a = in_hand[edge.a];
    const double length = (state_.positions.col(edge.a) - state_.positions.col(edge.b)).norm();
    threads.push_back({holds_a ? edge.a : edge.b, holds_a ? edge.b : edge.a,
                       std::max((1 + kHandStretch) * edge.rest_length, length)});
  }
  const double per_width = std::min(scene_.fabric.stretch_warp, scene_.fabric.stretch_weft);
  const double stretch = std::min(kHandPull / (2 * radius * per_width), kHandStretch);
  return {ways, model_.pins, std::move(threads), grip, stretch};
}

double Simulation::asked_stretch() const {
  return holds_cloth() ? grab_->reach.asked(grab_->target, time()) : 0;
}

void Simulation::move_grab(const Vec3& target) {
  PLEAT_CHECK(grab_.has_value(), "a hand holds the cloth");
  if (target.allFinite()) grab_->target = target;
}

void Simulation::release_grab() {
  if (!grab_) return;
  model_.pins.resize(grab_->first_pin);
  grab_.reset();
  stepper_->refresh();
}

/// The hand's pins go as far towards the target as it leads them, at constant speed during the
/// coming step, so that substeps do not see a jump.
void Simulation::place_grab_pins() {
  const double step = scene_.method.step;
  const Vec3 offset = grab_->reach.move(state_, grab_->vertex, grab_->target, time() + step, step);
  for (std::size_t p = grab_->first_pin; p < model_.pins.size(); ++p) {
    Pin& pin = model_.pins[p];
    pin.place = state_.positions.col(pin.vertex);
    pin.motion = {Motion::Kind::move, offset, time(), time() + scene_.method.step, 0};
  }
}

}  // namespace pleat
