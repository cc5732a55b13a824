#include "core/run/run_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dynamics/stepper_type.h"
#include "core/model/elasticity.h"
#include "core/run/run_advice.h"

namespace pleat {
namespace {

/// Stretch of one edge that is no nonsense yet, whatever its load: trousers on a walk reach a
/// quarter at the fork for a moment, where legs wedge them.
constexpr double kLeastStretch = 0.35;
/// A fall that is stopped, and a load that one thread of many bears, pull so many times as much as
/// the weight at rest.
constexpr double kRoomForMotion = 10;
/// Cloth twice as long as it was made is beyond what any of its measurements say, whatever the
/// load. Particles with springs of their own may be made for it.
constexpr double kMostStretch = 1;
/// Pinned cloth that swings pulls by so many times its weight and air, beside a stretch that fabric
/// is not felt to have: a pendulum by three times, where a level row of pins shares it; a few pins
/// load single threads.
constexpr double kRoomForSwing = 10;
constexpr double kRoomForEvenSwing = 3;
constexpr double kLeastSoftness = 0.002;
/// Stretch below which no edge shows, and stored energy is not asked for.
constexpr double kLeastStored = 0.02;
/// The free end of a whip is so many times as fast as its handle.
constexpr double kWhip = 4;
constexpr double kLeastSpeed = 1;  // [m/s]
/// Half of what a step had to solve for is left. The next step begins there and makes it good,
/// unless so many looks in a row find the same: then the run falls behind its equations.
constexpr double kUnsolved = 0.5;
constexpr int kUnsolvedLooks = 5;
/// The default tolerance takes less for solved: it is no warning, though a stricter one was asked
/// for.
constexpr double kNotConverged = 1e-3;
/// Share of the vertices, on average since the start, that the guard of self-contact may hold back.
constexpr double kHeldBack = 0.01;

/// Force per strain of a gauge's edge [N].
double edge_stiffness(const Scene& scene, const GaugeEdge& edge) {
  const double per_width = std::min(scene.fabric.stretch_warp, scene.fabric.stretch_weft);
  return per_width * edge.rest_length;
}

/// The force per strain of everything that ends at what is held [N]; without pins, that of a cut
/// through the middle of the cloth.
double holding_stiffness(const Simulation& simulation) {
  const ClothModel& model = simulation.model();
  const std::vector<bool> is_held = model.pinned();
  double held = 0;
  double all = 0;
  const auto add = [&](VertexId a, VertexId b, double stiffness) {
    all += stiffness;
    if (is_held[a] != is_held[b]) held += stiffness;
  };
  if (simulation.scene().cloth->is_surface()) {
    for (const GaugeEdge& edge : simulation.gauge())
      add(edge.a, edge.b, edge_stiffness(simulation.scene(), edge));
    // A cut goes through as many edges as lie in one of the rows and columns that all are in.
    const auto n_edges = static_cast<double>(simulation.gauge().size());
    return held > 0 ? held : all / std::sqrt(2 * std::max(n_edges, 1.0));
  }
  double weakest = 0;
  for (const Spring& spring : model.springs) {
    const double stiffness = spring.stiffness * spring.rest_length;
    add(spring.a, spring.b, stiffness);
    if (stiffness > 0) weakest = weakest > 0 ? std::min(weakest, stiffness) : stiffness;
  }
  return held > 0 ? std::min(held, weakest) : weakest;
}

double greatest_height(const Vec3& up, const Positions& positions) {
  double greatest = -std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < positions.cols(); ++i)
    greatest = std::max(greatest, up.dot(positions.col(i)));
  return greatest;
}

/// Longer or shorter than at rest by more than this share of it. No root is taken: it is asked of
/// every edge after every step.
bool is_strained(const GaugeEdge& edge, const Positions& positions, double share) {
  const double square = squared_distance(positions, edge.a.value, edge.b.value);
  const double longest = (1 + share) * edge.rest_length;
  const double shortest = std::max(0.0, 1 - share) * edge.rest_length;
  return square > longest * longest || square < shortest * shortest;
}

struct Fastest {
  VertexId vertex;
  double speed = 0;  // [m/s]
};

Fastest fastest_of(const Positions& velocities) {
  Fastest fastest;
  double most = 0;
  for (int i = 0; i < velocities.cols(); ++i) {
    const double square = squared_norm(velocities, i);
    if (square <= most) continue;
    most = square;
    fastest.vertex = VertexId(i);
  }
  fastest.speed = std::sqrt(most);
  return fastest;
}

/// Unit vector against gravity; zero without gravity.
Vec3 up_of(const ClothModel& model) {
  return model.gravity.isZero(0) ? Vec3(0, 0, 0) : Vec3(-model.gravity.normalized());
}

/// Cloth along whose threads springs lie, that hangs from pins alone: its load is known.
bool has_known_load(const Simulation& simulation) {
  const ClothModel& model = simulation.model();
  return simulation.mesh() && !model.springs.empty() && !model.pins.empty() && !model.contact &&
         !model.meets_bodies() && !simulation.scene().model.tearing;
}

/// Way that cloth falls at most until its pins hold it [m], of a sample.
double slack(const Simulation& simulation) {
  constexpr std::size_t kSample = 32;
  const auto& pins = simulation.model().pins;
  const Positions& now = simulation.state().positions;
  const Positions& rest = simulation.rest_positions();
  const auto stride = [](std::size_t n) { return std::max<std::size_t>(1, n / kSample); };
  const auto n_vertices = static_cast<std::size_t>(now.cols());
  double most = 0;
  for (std::size_t i = 0; i < n_vertices; i += stride(n_vertices)) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < pins.size(); k += stride(pins.size())) {
      const auto pin = pins[k].vertex.value;
      const auto at = static_cast<Eigen::Index>(i);
      least = std::min(least,
                       (rest.col(at) - rest.col(pin)).norm() - (now.col(at) - now.col(pin)).norm());
    }
    most = std::max(most, least);
  }
  return most;
}

/// Hung from as many pins as a row has, side by side at one height: all threads bear the same.
bool is_hung_evenly(const Simulation& simulation) {
  constexpr double kLevel = 0.1;  // share of the row's length by which heights may differ
  const ClothModel& model = simulation.model();
  const auto n_pins = static_cast<double>(model.pins.size());
  if (n_pins * n_pins < model.n_vertices()) return false;
  const Positions& now = simulation.state().positions;
  Positions held(3, static_cast<Eigen::Index>(model.pins.size()));
  for (std::size_t p = 0; p < model.pins.size(); ++p)
    held.col(static_cast<Eigen::Index>(p)) = now.col(model.pins[p].vertex);
  const Eigen::RowVectorXd heights = up_of(model).transpose() * held;
  return heights.maxCoeff() - heights.minCoeff() <= kLevel * box_diagonal(held);
}

/// Speed of the fastest point of a solid that cloth may touch [m/s].
double fastest_point(const Collider& collider, const Simulation& simulation) {
  const Sphere around = ball_around(collider.shape);
  const double speed = collider.motion.velocity(around.centre, simulation.time()).norm();
  if (collider.motion.kind != Motion::Kind::turn) return speed;
  const Vec3 middle = collider.motion.pose(simulation.time()) * around.centre;
  const Positions& cloth = simulation.state().positions;
  const double farthest = (cloth.colwise() - middle).colwise().norm().maxCoeff();
  return speed + std::abs(collider.motion.rate) * std::min(around.radius, farthest);
}

double driven_speed(const Simulation& simulation) {
  double speed = 0;
  for (const Pin& pin : simulation.model().pins)
    speed = std::max(speed, pin.velocity(simulation.time()).norm());
  for (const Collider& collider : simulation.scene().colliders)
    if (collider.motion.kind != Motion::Kind::hold)
      speed = std::max(speed, fastest_point(collider, simulation));
  if (simulation.model().meets_bodies())
    for (const BodySurface& body : simulation.model().self_contact->bodies) {
      if (body.motion.kind == Motion::Kind::hold) continue;
      for (const auto& place : body.places.colwise())
        speed = std::max(speed, body.motion.velocity(place, simulation.time()).norm());
    }
  return speed;
}

}  // namespace

RunWatch::RunWatch(const Simulation& simulation) : energy_(simulation), rest_(simulation) {
  const ClothModel& model = simulation.model();
  const State& state = simulation.state();
  const double weight = model.masses.sum() * model.gravity.norm();
  stiffness_ = holding_stiffness(simulation);
  const bool is_surface = simulation.scene().cloth->is_surface();
  const double pull = stiffness_ > 0 ? kRoomForMotion * weight / stiffness_ : 0;
  load_stretch_ =
      is_surface ? std::clamp(pull, kLeastStretch, kMostStretch) : std::max(pull, kLeastStretch);
  // Cloth that starts as the wreck of another run does not explain more wreck.
  start_stretch_ = stretch(simulation.gauge(), state.positions).largest;
  if (is_surface) start_stretch_ = std::min(start_stretch_, kMostStretch);
  has_known_load_ = has_known_load(simulation) && stiffness_ > 0;
  soft_stretch_ = has_known_load_ ? kLeastSoftness : std::numeric_limits<double>::infinity();
  stored_stretch_ = energy_.is_bounded(simulation) ? kLeastStored + start_stretch_
                                                   : std::numeric_limits<double>::infinity();
  start_slack_ = has_known_load_ ? slack(simulation) : 0;
  room_for_swing_ = is_hung_evenly(simulation) ? kRoomForEvenSwing : kRoomForSwing;
  start_height_ = greatest_height(up_of(model), state.positions);
  const double mass = model.masses.sum();
  const double stored = elastic_energy(model, state.positions);
  start_speed_ = fastest_of(state.velocities).speed +
                 (mass > 0 ? std::sqrt(2 * std::max(0.0, stored) / mass) : 0);
}

void RunWatch::check(const Simulation& simulation, const SolveReport& step) {
  driven_speed_ = std::max(driven_speed_, driven_speed(simulation));
  check_stretch(simulation);
  check_speed(simulation);
  check_report(simulation, step);
  check_cloth_contact(simulation);
  tell_unbalanced(simulation, rest_.after_step(simulation));
}

void RunWatch::check_end(const Simulation& simulation) {
  tell_unbalanced(simulation, rest_.at_end(simulation));
}

double RunWatch::unbalanced_share() const {
  return rest_.last() ? rest_.last()->share : std::numeric_limits<double>::quiet_NaN();
}

void RunWatch::tell_unbalanced(const Simulation& simulation,
                               const std::optional<RestWatch::Look>& look) {
  if (!look || look->share <= look->bound) return;
  warn(simulation,
       {RunWarning::Kind::unbalanced, look->time, VertexId(0), look->share, look->bound, {}});
}

/// The largest stretch that pins ask for by how far they are apart.
double RunWatch::stretch_between_pins(const Simulation& simulation) {
  return pin_stretch_.largest(simulation.model().pins, simulation.rest_positions(),
                              simulation.state().positions);
}

// Weight and air pull at what holds the cloth; what it falls by before they do, and what drives it,
// comes as a wave of strain v/c, c = sqrt(K/W) the speed of sound along a thread. Pins that pull
// apart load threads as no one knows.
double RunWatch::explained_softness(const Simulation& simulation) {
  if (!has_known_load_ || stretch_between_pins(simulation) > kLeastSoftness)
    return std::numeric_limits<double>::infinity();
  const ClothModel& model = simulation.model();
  const FabricConstants& fabric = simulation.scene().fabric;
  double load = model.masses.sum() * model.gravity.norm();
  if (model.air) {
    AirDrag air = *model.air;
    air.evaluate(simulation.state().positions, simulation.state().velocities);
    load += air.forces().colwise().norm().sum();
  }
  const double fall = std::sqrt(2 * model.gravity.norm() * start_slack_);
  const double sound =
      std::sqrt(std::min(fabric.stretch_warp, fabric.stretch_weft) / fabric.areal_density);
  return kLeastSoftness + room_for_swing_ * load / stiffness_ + start_stretch_ +
         (fall + driven_speed_ + start_speed_) / sound;
}

void RunWatch::check_stretch(const Simulation& simulation) {
  const Positions& positions = simulation.state().positions;
  const double most = load_stretch_ + start_stretch_;
  struct Worst {
    double strain = 0;
    VertexId vertex{0};
  };
  Worst longest, worst;  // elongation alone; either
  const double least = std::min({soft_stretch_, stored_stretch_, most});
  for (const GaugeEdge& edge : simulation.gauge()) {
    if (!is_strained(edge, positions, std::max(longest.strain, least))) continue;
    const double by = strain(edge, positions);
    if (by > longest.strain) longest = {by, edge.a};
    if (std::abs(by) > worst.strain) worst = {std::abs(by), edge.a};
  }
  const auto is_nonsense = [&] {
    return !warnings_.empty() && warnings_[0].kind == RunWarning::Kind::stretch;
  };
  const auto is_softer = [&] {
    return longest.strain > soft_stretch_ && !is_nonsense() && !simulation.is_disturbed();
  };
  const bool asks_for_energy = longest.strain > stored_stretch_;
  if (worst.strain <= most && !asks_for_energy && !is_softer()) return;
  const double by_load = explained_softness(simulation);
  const double share = asks_for_energy ? energy_.explained_share(simulation)
                                       : std::numeric_limits<double>::infinity();
  const auto tell = [&](RunWarning::Kind kind, const Worst& of, double bound) {
    if (of.strain <= bound) return;
    warn(simulation, {kind, simulation.time(), of.vertex, of.strain, bound, {}},
         of.strain / std::min({bound, by_load, share * of.strain}));
  };
  if (worst.strain > most)
    tell(RunWarning::Kind::stretch, worst, most + stretch_between_pins(simulation));
  if (share < 1) {
    if (!is_nonsense()) tell(RunWarning::Kind::soft, longest, share * longest.strain);
    stored_stretch_ = longest.strain;
  }
  if (!is_softer()) return;
  soft_stretch_ = std::max(soft_stretch_, by_load);
  tell(RunWarning::Kind::soft, longest, soft_stretch_);
  soft_stretch_ = std::max(soft_stretch_, longest.strain);
}

void RunWatch::check_speed(const Simulation& simulation) {
  const ClothModel& model = simulation.model();
  const State& state = simulation.state();
  const Fastest fastest = fastest_of(state.velocities);
  const double at_start = driven_speed_ + start_speed_ + kLeastSpeed;
  if (fastest.speed <= kWhip * at_start) return;
  const double drop =
      std::max(0.0, start_height_ + greatest_height(-up_of(model), state.positions));
  const double explained = std::sqrt(2 * model.gravity.norm() * drop) + at_start;
  if (fastest.speed <= kWhip * explained) return;
  warn(simulation, {RunWarning::Kind::speed,
                    simulation.time(),
                    fastest.vertex,
                    fastest.speed,
                    kWhip * explained,
                    {}});
}

void RunWatch::check_report(const Simulation& simulation, const SolveReport& step) {
  const bool is_unsolved =
      simulation.scene().method.stepper->solves_equations && step.relative_residual > kUnsolved;
  n_unsolved_ = is_unsolved ? n_unsolved_ + 1 : 0;
  if (n_unsolved_ == 1) unsolved_since_ = simulation.time();
  const auto told = [&](RunWarning::Kind kind, double since, double bound) {
    warn(simulation, {kind, since, VertexId(0), step.relative_residual, bound, {}}, 1);
  };
  if (n_unsolved_ >= kUnsolvedLooks)
    told(RunWarning::Kind::unsolved, unsolved_since_, kUnsolved);
  else if (step.status == SolveStatus::not_converged && step.relative_residual > kNotConverged)
    told(RunWarning::Kind::not_converged, simulation.time(), kNotConverged);
  else if (step.ok() && !step.message.empty())
    told(RunWarning::Kind::given_up, simulation.time(), 0);
}

void RunWatch::check_cloth_contact(const Simulation& simulation) {
  const ClothContact* contact = simulation.stepper().cloth_contact();
  if (contact == nullptr) return;
  const double share = contact->held_back_share();
  if (share > kHeldBack)
    warn(simulation, {RunWarning::Kind::held_back, simulation.time(), {}, share, kHeldBack, {}});
  if (const auto n = static_cast<double>(contact->sums().n_blocked); n > 0)
    warn(simulation, {RunWarning::Kind::blocked, simulation.time(), {}, n, 1, {}});
}

void RunWatch::warn(const Simulation& simulation, RunWarning warning) {
  const double excess = warning.value / warning.bound;
  warn(simulation, std::move(warning), excess);
}

/// Keeps the first time and the worst value, and advises by that.
void RunWatch::warn(const Simulation& simulation, RunWarning warning, double excess) {
  for (RunWarning& known : warnings_) {
    if (known.kind != warning.kind) continue;
    if (warning.value <= known.value) return;
    known.value = warning.value;
    known.vertex = warning.vertex;
    known.hints = hints_for(known.kind, excess, simulation.scene());
    return;
  }
  warning.hints = hints_for(warning.kind, excess, simulation.scene());
  warnings_.push_back(std::move(warning));
  std::stable_partition(warnings_.begin(), warnings_.end(),
                        [](const RunWarning& known) { return known.is_nonsense(); });
}

}  // namespace pleat
