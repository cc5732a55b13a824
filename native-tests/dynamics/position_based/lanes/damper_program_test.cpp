#include "core/dynamics/position_based/lanes/damper_program.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <vector>

#include "core/dynamics/stepper_table.h"
#include "core/model/momentum.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/graded_sheets.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr double kDamperSubstep = 1e-3;  // [s]
constexpr double kRounding = 6e-8;       // single precision, relative
constexpr double kStiffest = 1e6;        // factor on the damping of a fabric

/// Vertices of a model in single precision, moving.
struct MovingLanes {
  LaneLayout layout;
  std::size_t size;
  std::vector<float> data;

  MovingLanes(const ClothModel& model, const State& state)
      : layout(lane_layout(model)),
        size(static_cast<std::size_t>(layout.n_slots)),
        data(10 * size, 0.0f) {
    for (int i = 0; i < model.n_vertices(); ++i) {
      const std::size_t slot = slot_of(i);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<Eigen::Index>(k);
        data[k * size + slot] = static_cast<float>(kDamperSubstep * state.velocities(axis, i));
        data[(3 + k) * size + slot] = static_cast<float>(state.positions(axis, i));
      }
      if (!model.hangs(VertexId(i)))
        data[9 * size + slot] = static_cast<float>(model.masses.mean() / model.masses[i]);
    }
    for (const Pin& pin : model.pins) data[9 * size + slot_of(pin.vertex.value)] = 0;
  }

  std::size_t slot_of(int vertex) const {
    return static_cast<std::size_t>(layout.places[static_cast<std::size_t>(vertex)].slot);
  }
  std::array<float*, 3> lanes(std::size_t first) {
    return {&data[first * size], &data[(first + 1) * size], &data[(first + 2) * size]};
  }
  LaneView view() {
    return {lanes(0), {&data[3 * size], &data[4 * size], &data[5 * size]}, &data[9 * size]};
  }
  void brake(const DamperProgram& dampers) { dampers.brake(view(), lanes(6)); }

  /// Places and velocities at the substep's end; hanging vertices between their parents.
  State state(const ClothModel& model) const {
    State state{Positions(3, model.n_vertices()), Positions(3, model.n_vertices())};
    for (int i = 0; i < model.n_vertices(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<Eigen::Index>(k);
        const double move = data[k * size + slot_of(i)];
        state.positions(axis, i) = data[(3 + k) * size + slot_of(i)] + move;
        state.velocities(axis, i) = (move - data[(6 + k) * size + slot_of(i)]) / kDamperSubstep;
      }
    place_between_parents(model.hanging, state);
    return state;
  }
};

/// Two vertices of unlike masses joined by a damper.
ClothModel damped_pair(double damping) {
  ClothModel model;
  model.masses.resize(2);
  model.masses << 0.01, 0.03;
  Spring spring;
  spring.a = VertexId(0);
  spring.b = VertexId(1);
  spring.rest_length = 1;
  spring.damping = damping;
  model.springs.push_back(spring);
  return model;
}

double kinetic_energy(const ClothModel& model, const State& state) {
  double energy = 0;
  for (int i = 0; i < model.n_vertices(); ++i)
    if (!model.hangs(VertexId(i)))
      energy += model.masses[i] * state.velocities.col(i).squaredNorm() / 2;
  return energy;
}

void shake(State& state, std::uint64_t seed) {
  Random random(seed);
  for (double& v : state.velocities.reshaped()) v = random.uniform(-1, 1);
}

/// Every damper so many times as strong.
ClothModel damped_sheet(const QuadMesh& mesh, double times) {
  ClothModel model = sheet_model(mesh, library_fabric("linen"));
  for (Spring& spring : model.springs) spring.damping *= times;
  return model;
}

/// A square sheet of so many cells of `cell` [m], as scenes make it, held by its upper edge and let
/// go level.
struct Swatch {
  ClothModel model;
  State state;

  Swatch(const Fabric& fabric, int cells, double cell) {
    SheetShape shape;
    shape.rows = shape.columns = cells;
    shape.width = shape.height = cells * cell;
    shape.warp_direction = {0, 0, 1};
    const QuadMesh mesh = QuadMesh::sheet(shape);
    model = sheet_model(mesh, constants(fabric, BendSource::at_rest));
    model.gravity = {0, -9.81, 0};
    state = rest_state(mesh);
    for (int v = 0; v <= cells; ++v)
      model.pins.push_back({VertexId(v), state.positions.col(v), {}});
  }

  /// Largest stretch of any spring after so many frames of `xpbd` at its defaults.
  double stretch_after(int frames) {
    const std::unique_ptr<Stepper> stepper =
        steppers::kXpbd.make(model, steppers::kXpbd.usual_method());
    for (int frame = 0; frame < frames; ++frame)
      if (!stepper->advance(state, frame * stepper->options().step).ok()) return HUGE_VAL;
    double most = 0;
    for (const Spring& spring : model.springs)
      most = std::max(most, (state.positions.col(spring.a) - state.positions.col(spring.b)).norm() /
                                    spring.rest_length -
                                1);
    return most;
  }
};

}  // namespace

TEST_CASE("dampers: a pair's relative motion along its spring falls to 1/(1 + h c (w_a + w_b))",
          "[dynamics]") {
  const double damping = GENERATE(1e-3, 1.0, 1e3, 1e9);  // [N s/m]
  const bool isotropic = GENERATE(false, true);
  const bool held = GENERATE(false, true);
  CAPTURE(damping, isotropic, held);
  ClothModel model = damped_pair(damping);
  if (isotropic) model.damping_direction = DampingDirection::isotropic;
  State state{Positions::Zero(3, 2), Positions::Zero(3, 2)};
  state.positions.col(1) << 0.6, 0, 0.8;
  state.velocities.col(1) << 2, -1, 3;
  if (held)
    model.pins.push_back({VertexId(0), state.positions.col(0), {}});
  else
    state.velocities.col(0) << 1, 1, 1;
  MovingLanes lanes(model, state);
  const State begin = lanes.state(model);
  lanes.brake(DamperProgram(model, lanes.layout, kDamperSubstep));
  const State end = lanes.state(model);
  CHECK(end.positions == begin.positions);
  const double w = (held ? 0 : 1 / 0.01) + 1 / 0.03;
  const double left = 1 / (1 + kDamperSubstep * damping * w);
  const Vec3 d = (begin.positions.col(0) - begin.positions.col(1)).normalized();
  const Vec3 motion = begin.velocities.col(0) - begin.velocities.col(1);
  const Vec3 braked = isotropic ? motion : Vec3(motion.dot(d) * d);
  const Vec3 expected = motion - (1 - left) * braked;
  const Vec3 motion_end = end.velocities.col(0) - end.velocities.col(1);
  CHECK((motion_end - expected).norm() < 8 * kRounding * motion.norm());
  if (!held)
    CHECK((momentum(model, end) - momentum(model, begin)).norm() <
          8 * kRounding * momentum(model, begin).norm());
}

TEST_CASE("dampers: none adds energy, however strong, and momentum is kept", "[dynamics]") {
  const double times = GENERATE(1e-3, 1.0, 1e3, kStiffest);
  const bool isotropic = GENERATE(false, true);
  const bool graded = GENERATE(false, true);  // vertices hang
  CAPTURE(times, isotropic, graded);
  const QuadMesh mesh = graded ? graded_sheet(3) : lying_sheet(9);
  ClothModel model = damped_sheet(mesh, times);
  if (isotropic) model.damping_direction = DampingDirection::isotropic;
  State state = rest_state(mesh);
  shake(state, 5);
  place_between_parents(model.hanging, state);
  MovingLanes lanes(model, state);
  const DamperProgram dampers(model, lanes.layout, kDamperSubstep);
  const State begin = lanes.state(model);
  double energy = kinetic_energy(model, begin);
  for (int pass = 0; pass < 10; ++pass) {
    lanes.brake(dampers);
    const double left = kinetic_energy(model, lanes.state(model));
    CHECK(left < energy * (1 + 8 * kRounding));
    energy = left;
  }
  const State end = lanes.state(model);
  // Every vertex is rounded by each of a dozen springs, in ten passes.
  const double noise = 120 * kRounding * model.masses.sum();  // 1 m/s at 1 m
  CHECK((momentum(model, end) - momentum(model, begin)).norm() < noise);
  if (!isotropic)
    CHECK((angular_momentum(model, end) - angular_momentum(model, begin)).norm() < noise);
}

TEST_CASE("dampers: along springs, what moves as a whole is not braked", "[dynamics]") {
  const bool graded = GENERATE(false, true);
  const QuadMesh mesh = graded ? graded_sheet(3) : lying_sheet(9);
  ClothModel model = damped_sheet(mesh, kStiffest);
  State state = rest_state(mesh);
  const Vec3 turn(0.3, -0.2, 0.5);  // [rad/s]
  for (Eigen::Index v = 0; v < state.positions.cols(); ++v)
    state.velocities.col(v) = Vec3(1, 2, 3) + turn.cross(Vec3(state.positions.col(v)));
  MovingLanes lanes(model, state);
  const State begin = lanes.state(model);
  lanes.brake(DamperProgram(model, lanes.layout, kDamperSubstep));
  // A move of 4 mm rounds velocities to 2e-7 m/s; springs are at their ends, h |turn| further on.
  CHECK((lanes.state(model).velocities - begin.velocities).colwise().norm().maxCoeff() <
        2 * kDamperSubstep * turn.squaredNorm());
}

TEST_CASE("dampers: four lanes together give what they give one by one, to the bit", "[dynamics]") {
  const int cells = GENERATE(2, 8, 13);
  const bool isotropic = GENERATE(false, true);
  const bool has_grid = GENERATE(false, true);
  CAPTURE(cells, isotropic, has_grid);
  const QuadMesh mesh = lying_sheet(cells);
  ClothModel model = damped_sheet(mesh, 1);
  if (isotropic) model.damping_direction = DampingDirection::isotropic;
  if (!has_grid) model.rest_coordinates.resize(2, 0);
  State state = rest_state(mesh);
  shake(state, 7);
  MovingLanes together(model, state);
  MovingLanes one_by_one(model, state);
  DamperProgram dampers(model, together.layout, kDamperSubstep);
  together.brake(dampers);
  dampers.compute_lane_by_lane();
  one_by_one.brake(dampers);
  CHECK(together.data == one_by_one.data);
}

TEST_CASE("dampers: cloth without is left alone", "[dynamics]") {
  const QuadMesh mesh = graded_sheet(3);
  const ClothModel model = damped_sheet(mesh, 0);
  CHECK(DamperProgram(model, lane_layout(model), kDamperSubstep).empty());
}

// 16 cells in a quarter of a second. With dampers inside the solve a third of these rows explode.
TEST_CASE("dampers: any fabric on any cells hangs from xpbd at its defaults", "[dynamics]") {
  const double cell = GENERATE(0.001, 0.0025, 0.005, 0.01, 0.025, 0.05);  // [m]
  for (const Fabric& fabric : fabric_library().fabrics) {
    CAPTURE(cell, fabric.name);
    CHECK(Swatch(fabric, 16, cell).stretch_after(15) < 0.02);
  }
}

// A swing pulls with some times the weight; at a millimetre no more than 20 cells bear that in 30
// substeps (docs/methods/xpbd.md, "Lines").
TEST_CASE("dampers: larger swatches swing from xpbd for longer", "[dynamics][long]") {
  const double cell = GENERATE(0.001, 0.0025, 0.005, 0.01, 0.025, 0.05);  // [m]
  const int cells = cell < 0.0024 ? 20 : cell < 0.005 ? 30 : 48;
  for (const Fabric& fabric : fabric_library().fabrics) {
    CAPTURE(cell, fabric.name);
    const double weight = 9.81 * fabric.areal_density.value * cells * cell;  // [N/m]
    const double stiffness = std::min(fabric.stretch_warp.value, fabric.stretch_weft.value);
    CHECK(Swatch(fabric, cells, cell).stretch_after(60) < 0.05 + 10 * weight / stiffness);
  }
}

}  // namespace pleat
