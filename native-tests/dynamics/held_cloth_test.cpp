#include <catch2/catch.hpp>
#include <cmath>

#include "core/dynamics/stepper_table.h"
#include "native-tests/support/models.h"
#include "native-tests/support/particle.h"

namespace pleat {
namespace {

const std::vector<const StepperType*>& holding_steppers() {
  static const std::vector<const StepperType*> steppers = {
      &steppers::kImplicitEuler, &steppers::kImex, &steppers::kNewton, &steppers::kProjective};
  return steppers;
}

MethodOptions method_of(const StepperType* type, double step) {
  MethodOptions options = type->usual_method();
  options.step = step;
  options.substeps = 1;
  if (options.solver == SolverKind::cg) options.tolerance = 1e-5;
  return options;
}

/// A square sheet on a solid, flat at first.
struct SheetOnSolid {
  ClothModel model;
  State state;

  Vec3 place() const { return state.positions.rowwise().mean(); }
  Vec3 velocity() const { return state.velocities.rowwise().mean(); }
  void run(const MethodOptions& options, double duration);
};

void SheetOnSolid::run(const MethodOptions& options, double duration) {
  const auto stepper = make_stepper(model, options);
  const int n_steps = static_cast<int>(std::lround(duration / options.step));
  for (int s = 0; s < n_steps; ++s) {
    const SolveReport report = stepper->advance(state, s * options.step);
    // Its rounds are few, and it says so.
    REQUIRE((report.ok() || options.stepper == &steppers::kProjective));
  }
}

/// A sheet of this width [m] whose middle is there and whose first side has this direction; the
/// other one is z.
SheetOnSolid sheet_on(const Collider& solid, int cells, double width, const Vec3& middle,
                      const Vec3& side) {
  SheetShape shape;
  shape.rows = shape.columns = cells;
  shape.width = shape.height = width;
  shape.warp_direction = side;
  shape.weft_direction = Vec3::UnitZ();
  shape.origin = middle - width / 2 * (side + Vec3::UnitZ());
  const QuadMesh mesh = QuadMesh::sheet(shape);
  SheetOnSolid sheet{sheet_model(mesh, library_fabric("linen")), rest_state(mesh)};
  sheet.model.gravity = Vec3(0, -9.81, 0);
  sheet.model.contact.emplace(std::vector<Collider>{solid}, ContactOptions{});
  return sheet;
}

constexpr double kBallRadius = 0.25;  // [m]
constexpr double kBallStart = 0.12;   // the sheet's middle from the ball's axis [m]

/// A sheet of 8 cm that touches a ball beside its top.
SheetOnSolid sheet_on_ball(double friction, int cells) {
  const double angle = std::asin(kBallStart / kBallRadius);
  const Vec3 normal(std::sin(angle), std::cos(angle), 0);
  const Vec3 down(normal.y(), -normal.x(), 0);
  return sheet_on(ball_collider(Vec3::Zero(), kBallRadius, friction), cells, 0.08,
                  1.002 * kBallRadius * normal, down);
}

Collider slanted_plane(double friction, double slope) {
  Collider plane = floor_collider(friction);
  plane.shape = Plane{Vec3::Zero(), Vec3(std::sin(slope), std::cos(slope), 0)};
  return plane;
}

}  // namespace

// The stepper xpbd remembers no contact: in small steps it knows the ball by the sweep alone.
TEST_CASE("held cloth: a sheet slides off a ball as small steps of xpbd let it", "[contact]") {
  constexpr double kDuration = 0.3;
  const double friction = GENERATE(0.0, 0.2);
  const int cells = GENERATE(6, 9);
  SheetOnSolid exact = sheet_on_ball(friction, cells);
  exact.run(method_of(&steppers::kXpbd, 1.0 / 12000), kDuration);
  const double way = exact.place().x() - kBallStart;
  REQUIRE(way > 0.08);
  struct Bound {
    double step;   // [s]
    double share;  // largest error, in shares of the way
  };
  // The way with friction differs by more: the force that rubs is that of the substep before.
  const Bound coarse{1.0 / 240, friction > 0 ? 0.06 : 0.05};
  const Bound fine{1.0 / 960, friction > 0 ? 0.045 : 0.025};
  for (const Bound& bound : {coarse, fine})
    for (const StepperType* type : holding_steppers()) {
      // Its ten rounds leave more, of friction most.
      const double of_rounds = friction > 0 ? 0.2 : 0.08;
      const double most = type == &steppers::kProjective ? of_rounds : bound.share;
      CAPTURE(type->name, friction, cells, bound.step);
      SheetOnSolid sheet = sheet_on_ball(friction, cells);
      sheet.run(method_of(type, bound.step), kDuration);
      CHECK((sheet.place() - exact.place()).norm() < most * way);
    }
}

// The floor gives by the end all that weight gave, and rubs by mu times that: the speed falls by
// mu g t. The friction of the last substep is still to come, which is a hundredth.
TEST_CASE("held cloth: a sheet that lands aslant loses mu times its weight", "[contact]") {
  constexpr double kFriction = 0.2;
  constexpr double kDuration = 0.4;
  constexpr double kSlope = 0.15;
  constexpr double kSpeed = 2;  // [m/s]
  constexpr double kWidth = 0.1;
  const int cells = GENERATE(6, 16);
  for (const StepperType* type :
       {&steppers::kImplicitEuler, &steppers::kImex, &steppers::kNewton}) {
    CAPTURE(type->name, cells);
    const Vec3 side(std::cos(kSlope), std::sin(kSlope), 0);
    const Vec3 middle(0, kWidth / 2 * std::sin(kSlope) + 0.002, 0);
    SheetOnSolid sheet = sheet_on(floor_collider(kFriction), cells, kWidth, middle, side);
    sheet.state.velocities.row(0).setConstant(kSpeed);
    sheet.run(method_of(type, 1.0 / 240), kDuration);
    CHECK(kSpeed - sheet.velocity().x() == Approx(kFriction * 9.81 * kDuration).epsilon(0.04));
  }
}

// A thread that a rough floor holds stretched by a hundredth: between its ends neighbours pull
// alike, so that it comes loose from its ends. Its tension passes as a wave would in a hundredth
// of the substep; the friction of half of its vertices holds a thousandth of it.
TEST_CASE("held cloth: a stretched thread comes loose from a rough floor at once", "[contact]") {
  constexpr int kVertices = 64;
  constexpr double kRest = 1e-3;  // [m]
  constexpr double kStretch = 0.01;
  constexpr double kStiffness = 100;  // [N/m]
  constexpr double kMass = 1e-8;      // [kg]
  for (const StepperType* type :
       {&steppers::kImplicitEuler, &steppers::kImex, &steppers::kNewton}) {
    CAPTURE(type->name);
    ClothModel model;
    model.masses = Eigen::VectorXd::Constant(kVertices, kMass);
    model.gravity = Vec3(0, -9.81, 0);
    model.contact.emplace(std::vector<Collider>{floor_collider(0.2)}, ContactOptions{});
    State state;
    state.positions = Positions::Zero(3, kVertices);
    state.velocities = Positions::Zero(3, kVertices);
    Positions forces = Positions::Zero(3, kVertices);
    forces.row(1).setConstant(9.81 * kMass);
    for (int i = 0; i < kVertices; ++i) {
      state.positions(0, i) = (1 + kStretch) * kRest * i;
      if (i > 0) model.springs.push_back({VertexId(i - 1), VertexId(i), kStiffness, kRest});
    }
    const auto stepper = make_stepper(model, method_of(type, 1.0 / 240));
    stepper->start_from_contact_forces(forces);
    REQUIRE(stepper->advance(state, 0).ok());
    const double middle = state.positions(0, kVertices / 2) - state.positions(0, kVertices / 2 - 1);
    CHECK(middle / kRest - 1 < 0.02 * kStretch);
  }
}

// Such a thread that ties to pins below the floor press to it by twenty times its weight. Nothing
// pulls a vertex up, and the floor's force alone would throw it off by three links.
TEST_CASE("held cloth: what comes loose from a floor that it is pressed to stays on it",
          "[contact]") {
  constexpr int kVertices = 64;
  constexpr double kRest = 1e-3;  // [m]
  constexpr double kStretch = 0.01;
  constexpr double kMass = 1e-8;               // [kg]
  constexpr double kDepth = 0.01;              // depth of the pins [m]
  constexpr double kPull = 20 * 9.81 * kMass;  // [N]
  for (const StepperType* type : holding_steppers()) {
    CAPTURE(type->name);
    ClothModel model;
    model.masses = Eigen::VectorXd::Constant(2 * kVertices, kMass);
    model.gravity = Vec3(0, -9.81, 0);
    model.contact.emplace(std::vector<Collider>{floor_collider(0.2)}, ContactOptions{});
    State state;
    state.positions = Positions::Zero(3, 2 * kVertices);
    state.velocities = Positions::Zero(3, 2 * kVertices);
    Positions forces = Positions::Zero(3, 2 * kVertices);
    for (int i = 0; i < kVertices; ++i) {
      const int below = kVertices + i;
      state.positions(0, i) = state.positions(0, below) = (1 + kStretch) * kRest * i;
      state.positions(1, below) = -kDepth;
      model.pins.push_back({VertexId(below), state.positions.col(below), {}});
      model.springs.push_back({VertexId(i), VertexId(below), 2 * kPull / kDepth, kDepth / 2});
      if (i > 0) model.springs.push_back({VertexId(i - 1), VertexId(i), 100, kRest});
      forces(1, i) = 9.81 * kMass + kPull;
    }
    const auto stepper = make_stepper(model, method_of(type, 1.0 / 240));
    stepper->start_from_contact_forces(forces);
    for (int s = 0; s < 3; ++s) {
      const SolveReport report = stepper->advance(state, s / 240.0);
      REQUIRE((report.ok() || type == &steppers::kProjective));
      CHECK(state.positions.row(1).head(kVertices).cwiseAbs().maxCoeff() < 1e-9);
    }
    CHECK(state.positions(0, 1) - state.positions(0, 0) < (1 + 0.5 * kStretch) * kRest);
  }
}

TEST_CASE("held cloth: a sheet slides down a slanted plane as a block does", "[contact]") {
  constexpr double kSlope = 0.35;
  constexpr double kDuration = 0.5;
  const double friction = GENERATE(0.0, 1e-9, 0.2);
  const bool is_tilted_by_gravity = GENERATE(false, true);
  const double slope = is_tilted_by_gravity ? 0 : kSlope;
  const Vec3 down(std::cos(slope), -std::sin(slope), 0);
  const double exact = 9.81 * (std::sin(kSlope) - friction * std::cos(kSlope)) * kDuration;
  for (const StepperType* type : holding_steppers()) {
    CAPTURE(type->name, friction, is_tilted_by_gravity);
    SheetOnSolid sheet = sheet_on(slanted_plane(friction, slope), 6, 0.3, Vec3::Zero(), down);
    if (is_tilted_by_gravity)
      sheet.model.gravity = 9.81 * Vec3(std::sin(kSlope), -std::cos(kSlope), 0);
    sheet.run(method_of(type, 1.0 / 240), kDuration);
    CHECK(down.dot(sheet.velocity()) == Approx(exact).epsilon(friction < 1e-3 ? 0.001 : 0.01));
  }
}

TEST_CASE("held cloth: a rough slanted plane holds a sheet still", "[contact]") {
  constexpr double kSlope = 0.35;
  for (const StepperType* type : holding_steppers()) {
    CAPTURE(type->name);
    SheetOnSolid sheet = sheet_on(slanted_plane(1, kSlope), 6, 0.3, Vec3::Zero(),
                                  Vec3(std::cos(kSlope), -std::sin(kSlope), 0));
    sheet.run(method_of(type, 1.0 / 240), 0.5);
    CHECK(sheet.state.velocities.norm() < 1e-9);
    CHECK(sheet.place().norm() < 1e-4);
  }
}

// A block of speed v comes v^2 / (2 mu g) far; backward Euler takes up to v h / 2 off.
TEST_CASE("held cloth: a sheet slides to rest along its way, and is at rest", "[contact]") {
  constexpr double kFriction = 0.3;
  const Vec3 start(0.8, 0, 0.6);
  const double step = GENERATE(1.0 / 60, 1.0 / 240, 1.0 / 960);
  for (const StepperType* type : holding_steppers()) {
    CAPTURE(type->name, step);
    SheetOnSolid sheet = sheet_on(floor_collider(kFriction), 6, 0.2, Vec3::Zero(), Vec3::UnitX());
    sheet.state.velocities.colwise() = start;
    sheet.run(method_of(type, step), 0.8);
    CHECK(sheet.state.velocities.cwiseAbs().maxCoeff() < 1e-9);
    const Vec3 exact = start * start.norm() / (2 * kFriction * 9.81);
    CHECK((sheet.place() - exact).norm() < 1.5 * step * start.norm());
    CHECK(sheet.place().cross(start).norm() < 0.01 * exact.norm());
  }
}

TEST_CASE("held cloth: on a belt a sheet comes to ride along", "[contact]") {
  const Vec3 belt(0.3, 0, 0.4);
  for (const StepperType* type : holding_steppers()) {
    CAPTURE(type->name);
    Collider solid = floor_collider(0.4);
    solid.motion = steady_motion(belt);
    SheetOnSolid sheet = sheet_on(solid, 6, 0.2, Vec3::Zero(), Vec3::UnitX());
    sheet.run(method_of(type, 1.0 / 240), 0.6);
    CHECK((sheet.state.velocities.colwise() - belt).cwiseAbs().maxCoeff() < 1e-9);
  }
}

// A ball comes up under a sheet. Moved alone, the first vertices would stretch their links by the
// way of a substep, which is a fifth of a link.
TEST_CASE("held cloth: the links of what a solid meets first know of it at once", "[contact]") {
  Collider ball = ball_collider(Vec3(0, -0.13, 0), 0.12, 0.3);
  ball.motion = steady_motion(Vec3(0, 1.2, 0));
  for (const StepperType* type :
       {&steppers::kImplicitEuler, &steppers::kImex, &steppers::kNewton}) {
    CAPTURE(type->name);
    SheetOnSolid sheet = sheet_on(ball, 10, 0.5, Vec3::Zero(), Vec3::UnitX());
    const auto stepper = make_stepper(sheet.model, method_of(type, 1.0 / 120));
    double stretch = 0;
    for (int s = 0; s < 12; ++s) {
      REQUIRE(stepper->advance(sheet.state, s / 120.0).ok());
      for (const Spring& spring : sheet.model.springs) {
        const Vec3 link = sheet.state.positions.col(spring.a) - sheet.state.positions.col(spring.b);
        if (spring.stiffness > 1000)
          stretch = std::max(stretch, link.norm() / spring.rest_length - 1);
      }
    }
    CHECK(stretch < 0.05);
  }
}

}  // namespace pleat
