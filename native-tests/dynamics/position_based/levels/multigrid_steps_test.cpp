#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/dynamics/stepper_table.h"
#include "native-tests/support/allocation_count.h"
#include "native-tests/support/meshes.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

const std::vector<const StepperType*> kHierarchical = {&steppers::kHpbd, &steppers::kMultigrid};

/// A sheet without bending, its upper edge held or its two upper corners.
struct Held {
  ClothModel model;
  State state;
};

enum class By { edge, corners };

Held held_sheet(const QuadMesh& mesh, By by) {
  Held sheet{sheet_model(mesh, library_fabric("fine cotton")), rest_state(mesh)};
  sheet.model.bends.clear();
  sheet.model.gravity = {0, -9.81, 0};
  sheet.model.rest_coordinates = mesh.rest_coordinates();
  sheet.model.surface.rest_positions = mesh.rest_positions();
  sheet.model.surface.triangles = mesh.triangles();
  const RestCoordinates& at = sheet.model.rest_coordinates;
  const double end = at.row(1).maxCoeff();
  for (Eigen::Index v = 0; v < at.cols(); ++v) {
    const bool is_corner = at(1, v) == 0 || at(1, v) == end;
    if (at(0, v) == 0 && (by == By::edge || is_corner))
      sheet.model.pins.push_back({VertexId(v), mesh.rest_positions().col(v), {}});
  }
  return sheet;
}

State after(Held sheet, const MethodOptions& method, int steps) {
  const auto stepper = make_stepper(sheet.model, method);
  for (int s = 0; s < steps; ++s) {
    const SolveReport report = stepper->advance(sheet.state, s * method.step);
    CAPTURE(report.message);
    REQUIRE_FALSE(report.ends_run());
  }
  return sheet.state;
}

double rms_stretch(const ClothModel& model, const Positions& x) {
  double sum = 0;
  for (const Spring& spring : model.springs) {
    const double stretch = (x.col(spring.a) - x.col(spring.b)).norm() / spring.rest_length - 1;
    sum += stretch * stretch / static_cast<double>(model.springs.size());
  }
  return std::sqrt(sum);
}

}  // namespace

TEST_CASE("multigrid: a sheet that hangs at rest stays there for 10 s, in any order of springs",
          "[dynamics][long]") {
  const std::uint64_t seed = GENERATE(1U, 2U);
  Held sheet = held_sheet(square_sheet(16), By::edge);
  REQUIRE(sheet.model.surface.rest_positions.row(1).maxCoeff() >
          sheet.model.surface.rest_positions.row(1).minCoeff() + 0.9);  // it hangs
  Random random(seed);
  for (std::size_t i = sheet.model.springs.size(); i > 1; --i)
    std::swap(
        sheet.model.springs[i - 1],
        sheet.model.springs[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(i)))]);
  MethodOptions method = steppers::kMultigrid.usual_method();
  // Lines have an order of their own.
  method.smoother_before = method.smoother_after = Smoother::gauss_seidel;
  method.substeps = 30;
  const State end = after(sheet, method, 600);
  CHECK((end.positions - sheet.state.positions).colwise().norm().maxCoeff() < 2e-3);
  CHECK(end.velocities.colwise().norm().maxCoeff() < 5e-2);
}

TEST_CASE("multigrid: it stretches a fraction of what as many sweeps of one level leave",
          "[dynamics]") {
  const By by = GENERATE(By::edge, By::corners);
  Held sheet = held_sheet(lying_sheet(32), by);
  sheet.model.gravity = {0, 0, -9.81};
  MethodOptions multigrid = steppers::kMultigrid.usual_method();
  multigrid.substeps = 10;
  MethodOptions pbd = steppers::kPbd.usual_method();
  pbd.substeps = 10;
  pbd.iterations = 3;  // take longer than a cycle
  const double ours = rms_stretch(sheet.model, after(sheet, multigrid, 20).positions);
  const double plain = rms_stretch(sheet.model, after(sheet, pbd, 20).positions);
  CAPTURE(ours, plain);
  CHECK(ours < 0.5 * plain);
}

TEST_CASE("multigrid: lines on the finest level leave half the stretch, and need a grid",
          "[dynamics]") {
  Held sheet = held_sheet(lying_sheet(32), By::corners);
  sheet.model.gravity = {0, 0, -9.81};
  MethodOptions lines = steppers::kMultigrid.usual_method();
  REQUIRE(lines.smoother_after == Smoother::lines);
  MethodOptions one_by_one = lines;
  one_by_one.smoother_before = one_by_one.smoother_after = Smoother::gauss_seidel;
  const Positions ours = after(sheet, lines, 20).positions;
  CHECK(rms_stretch(sheet.model, ours) <
        0.5 * rms_stretch(sheet.model, after(sheet, one_by_one, 20).positions));

  const auto remark = [&](const MethodOptions& method) {
    return make_stepper(sheet.model, method)->remark();
  };
  CHECK(remark(lines).empty());
  CHECK(remark(one_by_one).empty());
  MethodOptions mixed = lines;
  mixed.smoother_before = Smoother::sor;
  CHECK(remark(mixed) == "gauss_seidel in the place of lines, as the other smoother is none");
  sheet.model.rest_coordinates.resize(2, 0);
  for (Spring& spring : sheet.model.springs) spring.kind = SpringKind::other;
  CHECK(after(sheet, lines, 5).positions == after(sheet, one_by_one, 5).positions);
  CHECK(remark(lines) == "gauss_seidel in the place of lines, as this cloth has no grid");
  one_by_one.levels = 30;
  CHECK_THAT(remark(one_by_one), Catch::StartsWith("expected 30 coarser levels, got "));
}

TEST_CASE("multigrid: corners that are pulled too far apart stretch a sheet without throwing it",
          "[dynamics]") {
  const double pull = GENERATE(0.3, 1.0);  // pull on each corner [m], of a metre of cloth
  CAPTURE(pull);
  Held sheet = held_sheet(square_sheet(8), By::corners);
  auto& pins = sheet.model.pins;
  REQUIRE(pins.size() == 2);
  const Vec3 offset = pull * (pins[1].place - pins[0].place).normalized();
  pins[0].motion = {Motion::Kind::ease, -offset, 0, 2};
  pins[1].motion = {Motion::Kind::ease, offset, 0, 2};
  const MethodOptions method = steppers::kMultigrid.usual_method();
  const auto stepper = make_stepper(sheet.model, method);
  double fastest = 0;  // [m/s]
  for (int s = 0; s < 150; ++s) {
    REQUIRE_FALSE(stepper->advance(sheet.state, s * method.step).ends_run());
    fastest = std::max(fastest, sheet.state.velocities.colwise().norm().maxCoeff());
  }
  CHECK(fastest < 3 * pull);  // corners reach a quarter of that
}

TEST_CASE(
    "multigrid: threads stretch less where diagonals give way, and without any nothing changes",
    "[dynamics]") {
  Held sheet = held_sheet(lying_sheet(16), By::corners);
  sheet.model.gravity = {0, 0, -9.81};
  auto& pins = sheet.model.pins;
  REQUIRE(pins.size() == 2);
  const Vec3 offset = 0.25 * (pins[1].place - pins[0].place);
  pins[0].motion = {Motion::Kind::ease, offset, 0, 1};
  pins[1].motion = {Motion::Kind::ease, -offset, 0, 1};
  const MethodOptions ours = steppers::kMultigrid.usual_method();
  MethodOptions rigid = ours;
  rigid.constraints = Constraints::rigid;

  const auto stretch_of_threads = [&sheet](const MethodOptions& method) {
    ClothModel model = sheet.model;
    ClothModel threads = sheet.model;
    std::erase_if(threads.springs,
                  [](const Spring& spring) { return spring.kind == SpringKind::shear; });
    REQUIRE(threads.springs.size() < model.springs.size());
    State state = sheet.state;
    const auto stepper = make_stepper(model, method);
    double sum = 0;
    for (int s = 0; s < 60; ++s) {
      REQUIRE_FALSE(stepper->advance(state, s * method.step).ends_run());
      sum += rms_stretch(threads, state.positions);
    }
    return sum;
  };
  CHECK(stretch_of_threads(ours) < 0.9 * stretch_of_threads(rigid));

  for (Spring& spring : sheet.model.springs)
    if (spring.kind == SpringKind::shear) spring.kind = SpringKind::other;
  CHECK(after(sheet, ours, 5).positions == after(sheet, rigid, 5).positions);
}

/// How far a pendulum of 1 m that is let go at the horizontal has swung after so long [rad].
double swung(double seconds) {
  constexpr int kSteps = 100000;
  const double h = seconds / kSteps;
  double angle = 0;
  double velocity = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double half_way = velocity + h / 2 * 9.81 * std::cos(angle);
    const double middle = angle + h / 2 * velocity;
    velocity += h * 9.81 * std::cos(middle);
    angle += h * half_way;
  }
  return angle;
}

TEST_CASE("multigrid: carried acceleration loses a fraction of a pendulum's energy", "[dynamics]") {
  Held sheet = held_sheet(lying_sheet(1), By::edge);
  sheet.model.gravity = {0, 0, -9.81};
  constexpr int kSteps = 60;
  const auto off = [&](double carried) {  // error after one swing [m]
    MethodOptions method = steppers::kMultigrid.usual_method();
    method.carried_acceleration = carried;
    const Positions end = after(sheet, method, kSteps).positions;
    return std::abs(end(2, end.cols() - 1) + std::sin(swung(kSteps * method.step)));
  };
  CHECK(off(0) > 5e-3);
  CHECK(off(0.3) < 1e-3);
}

TEST_CASE("multigrid: carried acceleration leaves free fall and rest on a plane as they are",
          "[dynamics]") {
  Held sheet = held_sheet(lying_sheet(4), By::edge);
  sheet.model.pins.clear();
  sheet.model.gravity = {0, 0, -9.81};
  MethodOptions method = steppers::kMultigrid.usual_method();
  const Positions plain = after(sheet, method, 6).positions;
  method.carried_acceleration = 0.3;
  CHECK((after(sheet, method, 6).positions - plain).colwise().norm().maxCoeff() < 1e-6);

  const SolidShape plane = Plane{{0, 0, -0.1}, {0, 0, 1}};
  sheet.model.contact.emplace(std::vector<Collider>{{plane, {}, 0.3}}, ContactOptions{});
  const Positions at_rest = after(sheet, method, 30).positions;
  CHECK((at_rest.row(2).array() + 0.1).abs().maxCoeff() < 1e-6);
}

TEST_CASE("multigrid: cycles keep momentum, and the same input gives the same bits", "[dynamics]") {
  const auto* const type = GENERATE(from_range(kHierarchical));
  CAPTURE(type->name);
  Held sheet = held_sheet(square_sheet(12), By::edge);
  sheet.model.pins.clear();
  sheet.model.gravity.setZero();
  Random random(3);
  for (double& v : sheet.state.velocities.reshaped()) v = random.uniform(-1, 1);
  const Vec3 before = sheet.state.velocities * sheet.model.masses;
  const MethodOptions method = type->usual_method();
  const State end = after(sheet, method, 20);
  const Vec3 change = end.velocities * sheet.model.masses - before;
  CHECK(change.norm() < 1e-5 * sheet.model.masses.sum());
  const State again = after(sheet, method, 20);
  CHECK(again.positions == end.positions);
  CHECK(again.velocities == end.velocities);
}

TEST_CASE("multigrid: nothing is allocated after the first step", "[dynamics]") {
  if (!counts_allocations()) return;
  const auto* const type = GENERATE(from_range(kHierarchical));
  Held sheet = held_sheet(lying_sheet(12), By::corners);
  sheet.model.gravity = {0, 0, -9.81};
  MethodOptions method = type->usual_method();
  method.smoother_after = GENERATE(Smoother::lines, Smoother::gauss_seidel, Smoother::jacobi);
  const auto stepper = make_stepper(sheet.model, method);
  stepper->advance(sheet.state, 0);
  CHECK(allocations_in([&] { stepper->advance(sheet.state, method.step); }) == 0);
}

TEST_CASE("pbd: with compliance the stiffness is the spring's, however many sweeps", "[dynamics]") {
  const int sweeps = GENERATE(100, 400);
  Chain chain;
  ClothModel model = chain_model(chain);
  MethodOptions method = steppers::kPbd.usual_method();
  method.constraints = Constraints::compliant;
  method.iterations = sweeps;
  State state = hanging_state(chain);
  const double expected = -state.positions.row(1).minCoeff();
  const auto stepper = make_stepper(model, method);
  for (int s = 0; s < 300; ++s) REQUIRE_FALSE(stepper->advance(state, s * method.step).ends_run());
  CHECK(-state.positions.row(1).minCoeff() == Approx(expected).epsilon(1e-4));
}

}  // namespace pleat
