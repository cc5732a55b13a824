#include "core/run/response_study.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "core/base/check.h"
#include "core/dynamics/stepper_table.h"
#include "core/files/json_text.h"
#include "core/run/scene_model.h"
#include "core/run/simulation.h"
#include "core/run/timed_run.h"
#include "core/scene/rest_cloth.h"
#include "core/scene/tearing.h"

namespace pleat {
namespace {

constexpr double kFirstContact = 1e-6;  // [m]

Vec3 normal_at(const Collider& collider, const Vec3& place, double time) {
  return gap(swept(ContactPass::placed(collider, time), {}, Vec3::Zero()), place).normal;
}

void check_scene(const Scene& scene) {
  if (!scene.surface_solids.empty())
    throw InputError("/world/colliders",
                     "expected planes, spheres and capsules alone, as boxes and meshes have one "
                     "response, got others");
  if (scene.colliders.empty())
    throw InputError("/world/colliders", "expected a solid that the cloth falls on, got none");
  for (std::size_t k = 0; k < scene.colliders.size(); ++k)
    if (scene.colliders[k].motion.kind != Motion::Kind::hold)
      throw InputError("/world/colliders/" + std::to_string(k) + "/motion",
                       "expected hold, as responses are compared on solids at rest");
  if (!scene.method.stepper->reads("first_contact_m"))
    throw InputError("/method/stepper", std::string("expected one that parts a substep at first "
                                                    "contact, got ") +
                                            scene.method.stepper->name);
}

/// The scene with a step for each of its substeps.
Scene with_short_steps(Scene scene) {
  const int n_substeps = Simulation(scene).substeps();
  scene.method.step /= n_substeps;
  scene.method.substeps = 1;
  scene.method.explicit_share = 0;
  if (scene.method.first_contact == 0) scene.method.first_contact = kFirstContact;
  return scene;
}

/// Velocity of a vertex after a touch, by the law alone.
Vec3 answered(const Vec3& velocity, const Vec3& normal, double friction, ContactResponse response) {
  const double down = std::max(0.0, -normal.dot(velocity));
  const double change = response == ContactResponse::uniform ? 2 * down : down;
  const Vec3 along = velocity - normal.dot(velocity) * normal;
  const double speed = along.norm();
  const double left = speed > friction * change ? 1 - friction * change / speed : 0;
  return left * along + (normal.dot(velocity) + change) * normal;
}

Vec3 momentum(const ClothModel& model, const Positions& velocities) {
  return velocities * model.masses;
}

/// Steps the cloth as if there were no solids, and applies the law by itself.
class FrictionWatch {
 public:
  FrictionWatch(const Scene& scene, const Simulation& simulation)
      : response_(scene.contact_response), simulation_(simulation) {
    Scene free = scene;
    free.colliders.clear();
    model_ = scene_model(free, rest_cloth(free));
    stepper_ = make_stepper(model_, free.method);
  }

  void begin(const State& state, double time) {
    if (!has_begun_) expected_ = first_ = momentum(model_, state.velocities);
    has_begun_ = true;
    free_ = state;
    stepper_->advance(free_, time);
    expected_ += momentum(model_, free_.velocities) - momentum(model_, state.velocities);
  }

  void end() {
    const ContactPass& contact = *simulation_.model().contact;
    for (const ContactPass::Touch& touch : contact.touches()) {
      const Vec3 before = free_.velocities.col(touch.vertex);
      const double friction = contact.colliders()[static_cast<std::size_t>(touch.solid)].friction;
      const Vec3 law = answered(before, touch.normal, friction, response_);
      const Vec3 deviation = simulation_.state().velocities.col(touch.vertex) - law;
      const auto along = [&](const Vec3& v) {
        return (v - touch.normal.dot(v) * touch.normal).squaredNorm();
      };
      deviations_ += along(deviation);
      squares_ += along(before);
      expected_ += model_.masses[touch.vertex] * (law - before);
    }
  }

  FrictionCheck result() const {
    const Vec3 reached = momentum(model_, simulation_.state().velocities);
    return {deviations_ == 0 ? 0 : std::sqrt(deviations_ / squares_),
            (reached - expected_).norm() / std::max(first_.norm(), expected_.norm())};
  }

 private:
  ContactResponse response_;
  const Simulation& simulation_;
  ClothModel model_;
  std::unique_ptr<Stepper> stepper_;
  State free_;
  Vec3 first_{0, 0, 0};
  Vec3 expected_{0, 0, 0};
  bool has_begun_ = false;
  double deviations_ = 0;
  double squares_ = 0;
};

/// The normal velocities of the vertices that were touched so far.
class TouchedVertices {
 public:
  explicit TouchedVertices(const Simulation& simulation)
      : simulation_(simulation),
        solids_(static_cast<std::size_t>(simulation.model().n_vertices()), kUntouched) {}

  void measure(ResponseRun& run) {
    const ContactPass& contact = *simulation_.model().contact;
    for (const ContactPass::Touch& touch : contact.touches())
      solids_[static_cast<std::size_t>(touch.vertex)] = touch.solid;
    double sum = 0;
    int n = 0;
    for (std::size_t v = 0; v < solids_.size(); ++v) {
      if (solids_[v] == kUntouched) continue;
      const auto i = static_cast<Eigen::Index>(v);
      const Collider& solid = contact.colliders()[static_cast<std::size_t>(solids_[v])];
      const State& state = simulation_.state();
      const Vec3 normal = normal_at(solid, state.positions.col(i), simulation_.time());
      sum += std::pow(normal.dot(state.velocities.col(i)), 2);
      ++n;
    }
    run.normal_velocities.push_back(n == 0 ? 0 : std::sqrt(sum / n));
    run.n_touched = n;
    sum_ += sum;
    n_ += n;
    run.rms_normal_velocity = n_ == 0 ? 0 : std::sqrt(sum_ / static_cast<double>(n_));
  }

 private:
  static constexpr int kUntouched = -1;

  const Simulation& simulation_;
  std::vector<int> solids_;  // solid that touched each vertex last
  double sum_ = 0;
  std::int64_t n_ = 0;
};

void check_report(const SolveReport& report) {
  if (report.ends_run()) throw InputError("/method", "the run ended early: " + report.message);
}

/// Ends before the step with the first contact; `at` is that state.
ResponseRun run_from_contact(const Scene& scene, double window, State& at, double& first_contact) {
  Simulation simulation(scene);
  const auto n_steps = std::llround(scene.duration / scene.method.step);
  const auto n_window = std::max(1LL, std::llround(window / scene.method.step));
  ResponseRun run;
  std::optional<FrictionWatch> friction;
  if (simulation.stepper().contact_forces().cols() == 0) friction.emplace(scene, simulation);
  TouchedVertices touched(simulation);
  TimedRun timed(simulation, TimedRun::Parts::timed);
  std::int64_t n_left = n_window;
  for (std::int64_t s = 0; s < n_steps && n_left > 0; ++s) {
    const bool is_after = simulation.stepper().first_contact().has_value();
    if (!is_after) at = simulation.state();
    if (is_after && friction) friction->begin(simulation.state(), simulation.time());
    check_report(timed.step());
    if (!simulation.stepper().first_contact()) continue;
    if (!is_after) timed.clear_costs();
    if (is_after && friction) friction->end();
    touched.measure(run);
    --n_left;
  }
  if (!simulation.stepper().first_contact())
    throw InputError("/duration_s", "expected a time in which the cloth meets a solid");
  first_contact = *simulation.stepper().first_contact();
  if (n_left > 0)
    throw InputError("/duration_s", "expected at least " + Json(first_contact + window).dump() +
                                        " s, first contact and the time that is looked at after "
                                        "it, got " +
                                        Json(scene.duration).dump() + " s");
  run.contact_share = timed.parts().total(Part::contact) / timed.seconds();
  if (friction) run.friction = friction->result();
  return run;
}

}  // namespace

ResponseStudy study_response(Scene scene, double window) {
  PLEAT_CHECK(window > 0, "a window is positive");
  check_scene(scene);
  expect_whole(scene);
  scene = with_short_steps(scene);
  ResponseStudy study;
  study.substep = scene.method.step;
  State resting_at;
  State uniform_at;
  double contact = 0;
  scene.contact_response = ContactResponse::resting;
  study.resting = run_from_contact(scene, window, resting_at, study.first_contact);
  scene.contact_response = ContactResponse::uniform;
  study.uniform = run_from_contact(scene, window, uniform_at, contact);
  PLEAT_CHECK(contact == study.first_contact && resting_at.positions == uniform_at.positions &&
                  resting_at.velocities == uniform_at.velocities,
              "both responses begin at one state");
  return study;
}

}  // namespace pleat
