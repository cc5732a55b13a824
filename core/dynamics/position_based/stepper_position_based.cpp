#include "core/dynamics/position_based/stepper_position_based.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/simd.h"
#include "core/model/hanging_vertices.h"

namespace pleat {
namespace {

/// How long triangles are not asked what they feel of the air [s].
constexpr double kDragPeriod = 1.0 / 120;
/// Share of the bound D of -df/dv that counts until then. From 1/2 on, which is what uniform motion
/// changes f by while the speed of the air is the same, what is steady is come to.
constexpr double kResistanceShare = 0.6;

double step_of(const MethodOptions& options) { return options.step / options.substeps; }

}  // namespace

StepperPositionBased::StepperPositionBased(ClothModel& model, const MethodOptions& options,
                                           MakeProjections make_projections)
    : Stepper(model, options, options.substeps),
      layout_(lane_layout(model)),
      projections_(make_projections(model, options, layout_, spring_law(options.constraints),
                                    step_of(options))),
      free_turns_(layout_),
      mean_mass_(model.masses.mean()),
      pitch_(layout_.pitch()),
      data_(pitch_ * (carries() ? kArrays : gained), 0.0f),
      n_constraints_(active_springs(model).size() +
                     bend_constraints(model, step_of(options)).size()) {
  const double h = step_of(options);
  for (int k = 0; k < 3; ++k)
    fall_[static_cast<std::size_t>(k)] = static_cast<float>(model.gravity[k] * h * h);
  // A rigid spring has no damper: it lets nothing move along it.
  if (!is_rigid(spring_law(options.constraints))) {
    dampers_.emplace(model, layout_, h);
    if (dampers_->empty()) dampers_.reset();
  }
  if (model.air) {
    forces_.resize(3, model.n_vertices());
    air_.resize(kAirArrays * pitch_);
  }
  if (model.contact) {
    contact_.emplace(layout_);
    vertices_.resize(static_cast<std::size_t>(layout_.n_slots));
    for (int i = 0; i < model.n_vertices(); ++i)
      vertices_[static_cast<std::size_t>(slot_of(VertexId(i)))] = VertexId(i);
  }
  refresh();
}

void StepperPositionBased::refresh() {
  float* const inverse_masses = array(inverse_mass);
  for (int i = 0; i < model_.n_vertices(); ++i)
    inverse_masses[slot_of(VertexId(i))] =
        model_.hangs(VertexId(i)) ? 0 : static_cast<float>(mean_mass_ / model_.masses[i]);
  for (const Pin& pin : model_.pins) inverse_masses[slot_of(pin.vertex)] = 0;
  if (carries())
    for (int k = 0; k < 3; ++k)
      std::fill_n(array(gained + k), layout_.n_slots, fall_[static_cast<std::size_t>(k)]);
  pin_velocities_.setZero(3, static_cast<Eigen::Index>(model_.pins.size()));
  projections_->refresh_pins(model_, inverse_masses);
  free_turns_.refresh(model_, inverse_masses);
  refresh_rest_lengths();
}

// A constraint is at least worth what gravity moves its vertices by in a substep, and what single
// precision rounds of its length.
void StepperPositionBased::refresh_rest_lengths() {
  constexpr double kRounding = 4 * std::numeric_limits<float>::epsilon();
  projections_->refresh_rest_lengths(model_);
  double lengths = 0;
  for (const Spring& spring : model_.springs) lengths += spring.rest_length * spring.rest_length;
  const double h = step_of(options());
  residual_floor_ = model_.gravity.norm() * h * h * std::sqrt(static_cast<double>(n_constraints_)) +
                    kRounding * std::sqrt(lengths);
}

LaneView StepperPositionBased::view() {
  return {lanes(move), {array(begin), array(begin + 1), array(begin + 2)}, array(inverse_mass)};
}

// Addresses are taken once, for a step's conversions go through all vertices.
StepperPositionBased::MotionLanes StepperPositionBased::motion() {
  return {lanes(begin), lanes(move), lanes(rounded_off)};
}

Vec3 StepperPositionBased::position_of(const MotionLanes& motion, int slot) const {
  const auto along = [&](std::size_t k) {
    return origin_[static_cast<int>(k)] +
           (static_cast<double>(motion.begins[k][slot]) + motion.moves[k][slot]);
  };
  return {along(0), along(1), along(2)};
}

Vec3 StepperPositionBased::velocity_of(const MotionLanes& motion, int slot, double h) {
  const auto along = [&](std::size_t k) {
    return (static_cast<double>(motion.moves[k][slot]) - motion.rounded_off[k][slot]) / h;
  };
  return {along(0), along(1), along(2)};
}

void StepperPositionBased::set_motion(const MotionLanes& motion, int slot, const Vec3& position,
                                      const Vec3& velocity, double h) const {
  const auto set_along = [&](std::size_t k) {
    const double local = position[static_cast<int>(k)] - origin_[static_cast<int>(k)];
    const auto rounded = static_cast<float>(local);
    const auto remainder = static_cast<float>(local - rounded);
    motion.begins[k][slot] = rounded;
    motion.moves[k][slot] = remainder;
    motion.rounded_off[k][slot] = static_cast<float>(remainder - h * velocity[static_cast<int>(k)]);
  };
  set_along(0);
  set_along(1);
  set_along(2);
}

void StepperPositionBased::load(const State& state) {
  const PartScope scope(observer_, Part::convert);
  const double h = step_of(options());
  Vec3 least = state.positions.col(0);
  Vec3 most = least;
  for (Eigen::Index i = 1; i < state.positions.cols(); ++i) {
    least = least.cwiseMin(state.positions.col(i));
    most = most.cwiseMax(state.positions.col(i));
  }
  origin_ = 0.5 * (least + most);
  extent_ = (most - least).norm();
  take_from(state, h);
  if (contact_) contact_->begin_step(*model_.contact, layout_);
  substeps_left_ = substeps();
}

// begin' = begin + move is rounded; begin' - begin is not, for the two are near each other. So
// rounded_off' is exactly what the rounding took away, and goes into the next move.
template <bool carries>
void StepperPositionBased::predict() {
  const LaneView v = view();
  const std::array<float*, 3> begins = lanes(begin);
  const std::array<float*, 3> lows = lanes(rounded_off);
  const std::array<float*, 3> gained_before = carries ? lanes(gained) : lows;
  const Float4 carried = Float4::all(static_cast<float>(options().carried_acceleration));
  const Vec3Lanes<Float4> fall = {Float4::all(fall_[0]), Float4::all(fall_[1]),
                                  Float4::all(fall_[2])};
  const int n_slots = layout_.n_slots;
  for (int slot = 0; slot < n_slots; slot += Float4::kLanes) {
    const Float4 w = Float4::load(v.inverse_masses + slot);
    const Vec3Lanes<Float4> from = pleat::load<Float4>(begins, slot);
    const Vec3Lanes<Float4> moved = pleat::load<Float4>(v.moves, slot);
    Vec3Lanes<Float4> gains = {where_positive(w, fall.x), where_positive(w, fall.y),
                               where_positive(w, fall.z)};
    const Vec3Lanes<Float4> velocity = moved - pleat::load<Float4>(lows, slot);
    if constexpr (carries) {
      gains = gains + carried * (pleat::load<Float4>(gained_before, slot) - gains);
      pleat::store(velocity, gained_before, slot);
    }
    const Vec3Lanes<Float4> goes_on = velocity + gains;
    const Vec3Lanes<Float4> to = from + moved;
    const Vec3Lanes<Float4> remainder = moved - (to - from);
    pleat::store(to, begins, slot);
    pleat::store(remainder, lows, slot);
    pleat::store(remainder + goes_on, v.moves, slot);
  }
}

// A share that is carried of the last substep's projections is no outer force.
void StepperPositionBased::note_unconstrained() {
  const std::array<float*, 3> unconstrained = free_turns_.unconstrained();
  const auto n_slots = static_cast<std::size_t>(layout_.n_slots);
  for (std::size_t k = 0; k < 3; ++k) {
    const int which = static_cast<int>(k);
    const float* const moves = array(move + which);
    std::copy(moves, moves + n_slots, unconstrained[k]);
    if (!carries()) continue;
    const float* const velocities = array(gained + which);
    const float* const lows = array(rounded_off + which);
    for (std::size_t slot = 0; slot < n_slots; ++slot)
      unconstrained[k][slot] = (velocities[slot] + fall_[k]) + lows[slot];
  }
}

void StepperPositionBased::take_gains() {
  const std::array<float*, 3> gains = lanes(gained);
  for (int slot = 0; slot < layout_.n_slots; slot += Float4::kLanes) {
    const Vec3Lanes<Float4> velocity =
        pleat::load<Float4>(lanes(move), slot) - pleat::load<Float4>(lanes(rounded_off), slot);
    pleat::store(velocity - pleat::load<Float4>(gains, slot), gains, slot);
  }
}

// A pin that holds still is placed once a step, and goes on as it is: a move that is all rounded
// off.
void StepperPositionBased::place_pins(double time_end, double h) {
  const bool is_first = substeps_left_ == substeps();
  for (std::size_t p = 0; p < model_.pins.size(); ++p) {
    const Pin& pin = model_.pins[p];
    const bool holds = pin.motion.kind == Motion::Kind::hold;
    if (holds && !is_first) continue;
    const Vec3 place = pin.position(time_end);
    const int slot = slot_of(pin.vertex);
    for (int k = 0; k < 3; ++k) {
      const auto to_place = static_cast<float>(place[k] - origin_[k] - array(begin + k)[slot]);
      array(move + k)[slot] = to_place;
      if (holds) array(rounded_off + k)[slot] = to_place;
    }
    if (!holds && substeps_left_ == 1)
      pin_velocities_.col(static_cast<Eigen::Index>(p)) = (place - pin.position(time_end - h)) / h;
  }
}

// The air's forces on triangles cost more than all constraints, and are taken now and then. Until
// the next time the drag of a vertex is f - r D (v' - v), with f and the bound D of its resistance
// at the velocity v of then, v' that at a substep's end and r the share above.
void StepperPositionBased::find_air_drag(State& state, double h) {
  const PartScope scope(observer_, Part::forces);
  copy_to(state, h);
  forces_.setZero();
  model_.air->add_forces(state.positions, state.velocities, model_.hanging, forces_);
  for (int i = 0; i < model_.n_vertices(); ++i) {
    const int slot = slot_of(VertexId(i));
    Mat3 brake = Mat3::Zero();
    Vec3 gain = Vec3::Zero();
    if (array(inverse_mass)[slot] > 0) {  // else it hangs or is held
      const double per_mass = h / model_.masses[i];
      const Mat3 resistance = kResistanceShare * per_mass * model_.air->resistance(VertexId(i));
      const Mat3 left = (Mat3::Identity() + resistance).inverse();
      brake = Mat3::Identity() - left;
      gain = left * h * (per_mass * forces_.col(i) + resistance * state.velocities.col(i)) -
             brake * (h * h * model_.gravity);  // gravity is added afterwards
    }
    const std::array<double, kAirArrays> numbers = {gain[0],     gain[1],     gain[2],
                                                    brake(0, 0), brake(1, 1), brake(2, 2),
                                                    brake(0, 1), brake(0, 2), brake(1, 2)};
    for (std::size_t k = 0; k < kAirArrays; ++k)
      air_[k * pitch_ + static_cast<std::size_t>(slot)] = static_cast<float>(numbers[k]);
  }
}

void StepperPositionBased::add_air_drag() {
  const PartScope scope(observer_, Part::forces);
  const std::array<float*, 3> moves = lanes(move);
  const std::array<float*, 3> lows = lanes(rounded_off);
  const auto air = [this](std::size_t which, int slot) {
    return Float4::load(air_.data() + which * pitch_ + static_cast<std::size_t>(slot));
  };
  for (int slot = 0; slot < layout_.n_slots; slot += Float4::kLanes) {
    const Vec3Lanes<Float4> low = pleat::load<Float4>(lows, slot);
    const auto [x, y, z] = pleat::load<Float4>(moves, slot) - low;
    const Float4 xy = air(6, slot);
    const Float4 xz = air(7, slot);
    const Float4 yz = air(8, slot);
    pleat::store(low - Vec3Lanes<Float4>{air(0, slot) - air(3, slot) * x - xy * y - xz * z,
                                         air(1, slot) - xy * x - air(4, slot) * y - yz * z,
                                         air(2, slot) - xz * x - yz * y - air(5, slot) * z},
                 lows, slot);
  }
}

// Most vertices are far from solids or meet a single one: only the others are made double
// precision of.
void StepperPositionBased::resolve_contacts(double h) {
  const PartScope scope(observer_, Part::contact);
  contact_->place_solids(*model_.contact, origin_, extent_);
  const MotionLanes now = motion();
  const MotionLanes at_begin = {now.begins, now.rounded_off, now.rounded_off};
  for (const int slot : contact_->resolve(view(), now.rounded_off)) {
    const Vec3 place_begin = position_of(at_begin, slot);
    Vec3 place = position_of(now, slot);
    Vec3 velocity = velocity_of(now, slot, h);
    const VertexId vertex = vertices_[static_cast<std::size_t>(slot)];
    if (model_.contact->resolve(vertex, place_begin, place, velocity))
      set_motion(now, slot, place, velocity, h);
  }
}

void StepperPositionBased::limit_in_double(State& state, double time_end, double h) {
  positions_begin_ = state.positions;
  copy_to(state, h);
  correct(state, time_end, h, model_.masses);
  take_from(state, h);
}

void StepperPositionBased::take_from(const State& state, double h) {
  const MotionLanes lanes = motion();
  for (int i = 0; i < model_.n_vertices(); ++i)
    set_motion(lanes, slot_of(VertexId(i)), state.positions.col(i), state.velocities.col(i), h);
}

void StepperPositionBased::copy_to(State& state, double h) {
  const MotionLanes lanes = motion();
  for (int i = 0; i < model_.n_vertices(); ++i) {
    const int slot = slot_of(VertexId(i));
    state.positions.col(i) = position_of(lanes, slot);
    state.velocities.col(i) = velocity_of(lanes, slot, h);
  }
  place_between_parents(model_.hanging, state);
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref is handed on to be written through.
void StepperPositionBased::read_places(const State&, PositionsRef places) const {
  const float* const numbers = data_.data();
  for (int i = 0; i < model_.n_vertices(); ++i) {
    const auto slot = static_cast<std::size_t>(slot_of(VertexId(i)));
    for (std::size_t k = 0; k < 3; ++k)
      places(static_cast<int>(k), i) = origin_[static_cast<int>(k)] +
                                       (static_cast<double>(numbers[(begin + k) * pitch_ + slot]) +
                                        numbers[(move + k) * pitch_ + slot]);
  }
}

void StepperPositionBased::change(State&, VertexId vertex, const Vec3& place,
                                  const Vec3& velocity) {
  const double h = step_of(options());
  const MotionLanes now = motion();
  const int slot = slot_of(vertex);
  set_motion(now, slot, place, velocity_of(now, slot, h) + velocity, h);
}

// After contact, which reads from what is rounded off where a vertex was.
void StepperPositionBased::brake() {
  const PartScope scope(observer_, Part::solve);
  dampers_->brake(view(), lanes(rounded_off));
}

SolveReport StepperPositionBased::substep(State& state, double time_end, double h) {
  if (model_.air) {
    const int every = std::max(1, static_cast<int>(std::lround(kDragPeriod / h)));
    if ((substeps() - substeps_left_) % every == 0) find_air_drag(state, h);
    add_air_drag();
  }
  {
    const PartScope scope(observer_, Part::solve);
    carries() ? predict<true>() : predict<false>();
    place_pins(time_end, h);
    const LaneView v = view();
    const bool is_last = substeps_left_ == 1;
    if (is_last) {
      projections_->forget();
      residual_begin_ = std::sqrt(projections_->squared_residual(v));
    }
    if (!free_turns_.empty()) note_unconstrained();
    projections_->solve(v, options().iterations);
    if (!free_turns_.empty()) free_turns_.keep(v, origin_);
    if (carries()) take_gains();
    if (is_last) residual_end_ = std::sqrt(projections_->squared_residual(v));
  }
  if (strain_limit() != nullptr) {
    limit_in_double(state, time_end, h);
  } else if (model_.contact) {
    resolve_contacts(h);
  }
  if (dampers_) brake();
  --substeps_left_;
  time_end_ = time_end;
  SolveReport report;
  report.iterations = options().iterations;
  return report;
}

/// True where self-contact has not let a pin go its way: further than rounding.
bool StepperPositionBased::stayed_behind(const Vec3& at, const Vec3& place) const {
  constexpr double kFarther = 1e-8;  // relative
  return cloth_contact() != nullptr && (at - place).norm() > kFarther * (extent_ + 1e-3);
}

/// The residual is relative to that of the predicted places, but where these are right already, as
/// of cloth that falls, slides or lies, to what weight could make of it.
void StepperPositionBased::store(State& state, SolveReport& report) {
  const PartScope scope(observer_, Part::convert);
  copy_to(state, step_of(options()));
  for (std::size_t p = 0; p < model_.pins.size(); ++p) {
    const Vec3 place = model_.pins[p].position(time_end_);
    if (stayed_behind(state.positions.col(model_.pins[p].vertex.value), place)) continue;
    state.positions.col(model_.pins[p].vertex.value) = place;
    state.velocities.col(model_.pins[p].vertex.value) =
        pin_velocities_.col(static_cast<Eigen::Index>(p));
  }
  place_between_parents(model_.hanging, state);
  const double scale = std::max(residual_begin_, residual_floor_);
  report.relative_residual = scale > 0 ? residual_end_ / scale : 0;
}

}  // namespace pleat
