#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/run/hand_reach.h"
#include "core/run/moving_cloth.h"
#include "core/run/scene_model.h"
#include "core/run/transition.h"
#include "core/scene/scene.h"

namespace pleat {

/// A scene in motion.
class Simulation final : public MovingCloth {
 public:
  /// Throws InputError when the scene's method cannot run on it.
  explicit Simulation(const Scene& scene);

  /// One step of scene.method.step. Cloth that tears does so first. After a report that is not ok
  /// or not_converged the state is the last finite one and further steps return that report.
  SolveReport step() override;
  /// Starts anew, whole.
  void reset();

  /// Starts from these places at rest [m], one column a vertex, now and at each reset. Pins are
  /// where that puts their vertices. Throws InputError unless there are as many, all are finite and
  /// off bodies.
  void start_from(const PositionsView& positions);

  /// Goes on from this state at a time of the scene's own [s]: pins and solids are where they are
  /// then, hanging vertices in the middle of their parents. A reset starts the scene. Throws
  /// InputError unless there are as many places and velocities as vertices and all are finite.
  ///
  /// contact_accelerations  by which solids held the vertices in the substep before [m/s^2], as
  ///                        contact_accelerations has them; no columns for none
  void go_on_from(const State& state, double time,
                  const Positions& contact_accelerations = Positions(3, 0));

  /// Takes the motion of `old` over: vertices that both meshes share keep position and velocity to
  /// the bit, new ones are interpolated along the mesh lines. Forces turn into this scene's own
  /// within kTransitionTime; until then it does not tear. Moments of inner friction go on where the
  /// same three vertices follow each other, and start at zero elsewhere. Throws ContractError
  /// unless both are sheets with the same base mesh, and `old` is whole.
  void carry_over(const Simulation& old);

  /// Holds every vertex within the hand's radius (kHandRadius of the rest diagonal; of
  /// particles, only the vertex itself) of `vertex` and moves them together; of one that hangs,
  /// the parents; of one that is pinned, which stays, none. One hand at a time. It pulls cloth that
  /// does not tear no further than its force stretches it (kHandPull), and no faster than
  /// kHandSpeed.
  void grab(VertexId vertex);
  bool is_grabbed() const { return grab_.has_value(); }
  /// Sets where the hand wants the grabbed vertex at the end of the next step [m].
  void move_grab(const Vec3& target);
  /// How many times as long as at rest the tautest thread would be, were the grabbed vertex where
  /// the hand wants it; 0 where nothing else holds the cloth, or the hand holds none.
  double asked_stretch() const;
  void release_grab();

  /// True when since the start a hand, other places to start from or another scene's cloth has led
  /// this one astray: it does not show what its scene alone would.
  bool is_disturbed() const { return was_led_astray_ || start_positions_.has_value(); }

  const Scene& scene() const { return scene_; }
  /// The equations of motion; for kTransitionTime after carry_over on their way to the scene's.
  const ClothModel& model() const override { return model_; }
  /// The edges that stretch is measured by.
  const std::vector<GaugeEdge>& gauge() const override { return gauge_; }
  const State& state() const override { return state_; }
  const QuadMesh* mesh() const override { return cloth_.quads ? &*cloth_.quads : nullptr; }
  const std::vector<Triangle>& triangles() const { return cloth_.mesh.triangles; }
  /// Positions in which the scene starts [m].
  const Positions& rest_positions() const { return cloth_.mesh.rest_positions; }
  /// Vertex that each one appended by a tear since the start was split from: the vertices before
  /// are those of the whole cloth.
  std::span<const VertexId> tear_origins() const { return tear_origins_; }
  /// Pins of the scene, without those of a hand.
  std::span<const Pin> own_pins() const {
    return {model_.pins.data(), grab_ ? grab_->first_pin : model_.pins.size()};
  }
  /// Another number after each change of vertices and triangles.
  std::int64_t topology() const { return topology_; }
  /// The rest area of each vertex [m^2]; particles count by their mass.
  Eigen::VectorXd rest_areas() const { return pleat::rest_areas(cloth_); }
  /// Steps since the start or what it last went on from.
  std::int64_t n_steps() const { return n_steps_; }
  double time() const override {
    return time_begin_ + static_cast<double>(n_steps_) * scene_.method.step;
  }
  int substeps() const { return stepper_->substeps(); }
  /// Another one after each reset and tear.
  const Stepper& stepper() const { return *stepper_; }
  /// Contact forces over the vertices' masses [m/s^2]; zero where vertices hang.
  Positions contact_accelerations() const;
  /// The longest substep that is surely stable [s]; nothing where the method has no bound.
  std::optional<double> stability_bound() const;
  void observe(PartObserver* observer) override;

 private:
  void expect_outside_of_solids() const;
  void expect_outside_of_bodies() const;
  struct Grab {
    VertexId vertex;
    std::size_t first_pin;  // its pins are the last of model_.pins
    Vec3 target;            // place that the hand wants `vertex` at after the next step [m]
    HandReach reach;
  };

  void start();
  void take_cloth(RestCloth cloth);
  void tear();
  void make_whole();
  bool holds_cloth() const { return grab_ && grab_->first_pin < model_.pins.size(); }
  void place_grab_pins();
  /// Vertices that go with a hand at this one.
  std::vector<bool> in_hand_at(VertexId vertex, double radius) const;
  HandReach reach_of(VertexId vertex, double radius, const std::vector<bool>& in_hand) const;
  void end_transition();

  Scene scene_;
  RestCloth cloth_;
  ClothModel model_;
  std::vector<GaugeEdge> gauge_;
  std::vector<VertexId> tear_origins_;
  std::int64_t topology_ = 0;
  std::optional<Positions> start_positions_;  // when not those of the scene [m]
  State state_;
  std::unique_ptr<Stepper> stepper_;
  PartObserver* observer_ = nullptr;
  double time_begin_ = 0;  // when this cloth went on from another's state [s]
  std::int64_t n_steps_ = 0;
  bool was_led_astray_ = false;
  std::optional<Grab> grab_;
  std::optional<Transition> transition_;
  SolveReport ended_;
};

constexpr double kHandRadius = 0.03;  ///< share of the rest diagonal

}  // namespace pleat
