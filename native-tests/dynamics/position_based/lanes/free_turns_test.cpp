#include "core/dynamics/position_based/lanes/free_turns.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "core/dynamics/stepper_table.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr double kTurnStep = 1.0 / 240;  // [s]

struct TurningCloth {
  ClothModel model;
  State state;
};

/// A turning_cloth sheet of 5 x 5 vertices with weight, held by so many vertices of its left
/// border.
TurningCloth turning_cloth(int n_held) {
  const QuadMesh mesh = square_sheet(4);
  TurningCloth cloth{sheet_model(mesh, soft_fabric()), rest_state(mesh)};
  for (Spring& spring : cloth.model.springs) spring.stiffness *= 10;
  cloth.model.masses[24] *= 10;  // so that the centre of mass is not in the middle
  cloth.model.gravity = {0, -9.81, 0};
  cloth.model.surface.rest_positions = mesh.rest_positions();
  cloth.model.surface.triangles = mesh.triangles();
  Random random(3);
  cloth.state.positions = shaken(cloth.state.positions, 0.05, random);
  for (int i = 0; i < n_held; ++i) {
    const VertexId vertex(5 * i);
    const Vec3 place(0, -0.25 * i, 0);
    cloth.state.positions.col(vertex) = place;
    cloth.model.pins.push_back({vertex, place, {}});
  }
  return cloth;
}

Vec3 angular_momentum_about(const Vec3& point, const TurningCloth& cloth) {
  Vec3 total = Vec3::Zero();
  for (int i = 0; i < cloth.model.n_vertices(); ++i)
    total += cloth.model.masses[i] *
             Vec3(cloth.state.positions.col(i) - point).cross(Vec3(cloth.state.velocities.col(i)));
  return total;
}

/// Change of that by weight within a step of h [s].
Vec3 turn_by_weight(const Vec3& point, const TurningCloth& cloth, double h) {
  Vec3 total = Vec3::Zero();
  for (int i = 0; i < cloth.model.n_vertices(); ++i)
    total += h * cloth.model.masses[i] *
             Vec3(cloth.state.positions.col(i) - point).cross(cloth.model.gravity);
  return total;
}

MethodOptions method_by(const StepperType* stepper) {
  MethodOptions method = stepper->usual_method();
  method.step = kTurnStep;
  method.substeps = 1;
  method.iterations = 2;
  return method;
}

const StepperType* any_position_based() {
  return GENERATE(&steppers::kXpbd, &steppers::kPbd, &steppers::kHpbd, &steppers::kMultigrid);
}

/// Angular momentum that 60 steps add beside that of weight, over the largest that cloth has.
Vec3 share_beside_weight(TurningCloth cloth, const MethodOptions& method, const Vec3& point) {
  const auto stepper = make_stepper(cloth.model, method);
  Vec3 by_weight = Vec3::Zero();
  double largest = 0;
  const Vec3 first = angular_momentum_about(point, cloth);
  for (int step = 0; step < 60; ++step) {
    by_weight += turn_by_weight(point, cloth, kTurnStep);
    REQUIRE(stepper->advance(cloth.state, step * kTurnStep).ok());
    double size = 0;
    for (int i = 0; i < cloth.model.n_vertices(); ++i)
      size += cloth.model.masses[i] * (cloth.state.positions.col(i) - point).norm() *
              cloth.state.velocities.col(i).norm();
    largest = std::max(largest, size);
  }
  return (angular_momentum_about(point, cloth) - first - by_weight) / largest;
}

}  // namespace

TEST_CASE("free turns: only weight turns cloth about the one point that holds it", "[dynamics]") {
  const MethodOptions method = method_by(any_position_based());
  CAPTURE(method.stepper->name);
  CHECK(share_beside_weight(turning_cloth(1), method, {0, 0, 0}).norm() < 1e-4);
}

TEST_CASE("free turns: nothing turns a flag about its pole", "[dynamics]") {
  const MethodOptions method = method_by(any_position_based());
  CAPTURE(method.stepper->name);
  const Vec3 share = share_beside_weight(turning_cloth(3), method, {0, 0, 0});
  CHECK(std::abs(share.y()) < 1e-4);
  CHECK(share.norm() > 1e-2);  // the pole takes up the other turns
}

TEST_CASE("free turns: free cloth keeps its angular momentum", "[dynamics]") {
  const MethodOptions method = method_by(any_position_based());
  CAPTURE(method.stepper->name);
  TurningCloth cloth = turning_cloth(0);
  cloth.model.gravity.setZero();
  for (int i = 0; i < cloth.model.n_vertices(); ++i)
    cloth.state.velocities.col(i) =
        Vec3(0.5, 1, -2).cross(Vec3(cloth.state.positions.col(i))) + Vec3(1, -2, 0.5);
  CHECK(share_beside_weight(cloth, method, {0, 0, 0}).norm() < 1e-4);
}

TEST_CASE("free turns: there are none in two pieces, about two lines or about pins that move",
          "[dynamics]") {
  TurningCloth cloth = turning_cloth(3);
  const LaneLayout layout = lane_layout(cloth.model);
  const std::vector<float> inverse_masses(static_cast<std::size_t>(layout.n_slots), 1.0f);
  FreeTurns turns(layout);
  const auto are_none = [&] {
    turns.refresh(cloth.model, inverse_masses.data());
    return turns.empty();
  };
  CHECK_FALSE(are_none());
  cloth.model.pins[1].motion.kind = Motion::Kind::ease;
  CHECK_FALSE(are_none());
  cloth.model.pins[1].motion.offset = {0, 0, 0.1};
  CHECK(are_none());
  cloth.model.pins[1].motion.offset.setZero();
  cloth.model.pins[1].motion.kind = Motion::Kind::turn;
  CHECK(are_none());
  cloth.model.pins[1].motion.kind = Motion::Kind::hold;
  cloth.model.pins[1].place.x() += 1e-3;
  CHECK(are_none());
  cloth.model.pins[1].place.x() -= 1e-3;
  CHECK_FALSE(are_none());
  cloth.model.gravity = {9.81, 0, 0};  // weight brings it back
  CHECK(are_none());
  cloth.model.gravity = {0, -9.81, 0};
  std::erase_if(cloth.model.springs,
                [](const Spring& spring) { return spring.a.value == 24 || spring.b.value == 24; });
  std::erase_if(cloth.model.bends, [](const BendElement& bend) {
    return bend.vertices[0].value == 24 || bend.vertices[2].value == 24;
  });
  CHECK(are_none());
}

}  // namespace pleat
