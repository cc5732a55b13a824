#include "core/dynamics/cloth_contact.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/dynamics/stepper_table.h"
#include "native-tests/support/allocation_count.h"

namespace pleat {
namespace {

constexpr double kThickness = 1e-3;  // [m]
constexpr double kGravity = 9.81;    // [m/s^2]

/// A square of cloth of 0.1 m, of stiff springs, that lies on a wide sheet of which every vertex is
/// pinned, in a plane of equal y.
struct LyingSquare {
  static constexpr int kWide = 7;  // vertices along an edge of the sheet
  ClothModel model;
  State state;
  int first;  // vertex of the square

  explicit LyingSquare(double friction, double gap = kThickness) : first(kWide * kWide) {
    const int n = first + 4;
    state.positions.resize(3, n);
    state.velocities = Positions::Zero(3, n);
    model.masses = Eigen::VectorXd::Constant(n, 1e-3);
    model.self_contact.emplace();
    for (int i = 0; i < first; ++i) {
      const int row = i / kWide;
      state.positions.col(i) << 0.5 * (i % kWide - 1), 0, 0.13 * (row - 3);
      model.pins.push_back({VertexId(i), state.positions.col(i), {}});
    }
    const std::array<Vec3, 4> square = {Vec3(0.013, gap, 0.021), Vec3(0.113, gap, 0.021),
                                        Vec3(0.113, gap, 0.121), Vec3(0.013, gap, 0.121)};
    for (std::size_t k = 0; k < 4; ++k) {
      state.positions.col(first + static_cast<int>(k)) = square[k];
      for (std::size_t m = 0; m < k; ++m)
        model.springs.push_back({VertexId(first + static_cast<int>(m)),
                                 VertexId(first + static_cast<int>(k)), 1e4,
                                 (square[k] - square[m]).norm()});
    }
    auto& faces = model.self_contact->faces;
    const auto face = [&](int a, int b, int c) {
      faces.push_back({VertexId(a), VertexId(b), VertexId(c)});
    };
    for (int r = 0; r + 1 < kWide; ++r)
      for (int c = 0; c + 1 < kWide; ++c) {
        const int at = r * kWide + c;
        face(at, at + 1, at + kWide + 1);
        face(at, at + kWide + 1, at + kWide);
      }
    face(first, first + 1, first + 2);
    face(first, first + 2, first + 3);
    model.self_contact->rest_positions = state.positions;
    model.self_contact->thickness = kThickness;
    model.self_contact->friction = friction;
    model.gravity = {0, -kGravity, 0};
  }

  void tilt(double angle) { model.gravity = kGravity * Vec3(std::sin(angle), -std::cos(angle), 0); }
  auto square() { return state.positions.rightCols(4); }
  double way(const Positions& start) const {
    return (state.positions.rightCols(4) - start.rightCols(4)).row(0).mean();
  }
};

MethodOptions method_of(const char* name) {
  MethodOptions method = find_stepper(standard_steppers(), name)->usual_method();
  method.step = 1.0 / 240;
  return method;
}

void run(LyingSquare& lying, const char* stepper_name, int n_steps) {
  const auto stepper = make_stepper(lying.model, method_of(stepper_name));
  for (int s = 0; s < n_steps; ++s)
    REQUIRE_FALSE(stepper->advance(lying.state, s / 240.0).ends_run());
}

}  // namespace

TEST_CASE("cloth_contact: cloth that falls on cloth comes to rest at the gap", "[dynamics]") {
  const char* const stepper = GENERATE("implicit", "xpbd");
  LyingSquare lying(0.3, 0.02);
  run(lying, stepper, 240);
  CHECK(lying.square().row(1).maxCoeff() == Approx(kThickness).epsilon(0.02));
  CHECK(lying.square().row(1).minCoeff() == Approx(kThickness).epsilon(0.02));
  CHECK(lying.state.velocities.cwiseAbs().maxCoeff() < 1e-4);
}

TEST_CASE("cloth_contact: on a slope cloth holds below the angle of friction", "[dynamics]") {
  const char* const stepper = GENERATE("implicit", "xpbd");
  const double friction = GENERATE(0.2, 0.6);
  LyingSquare lying(friction);
  lying.tilt(std::atan(0.99 * friction));
  const Positions start = lying.state.positions;
  run(lying, stepper, 240);
  CHECK(std::abs(lying.way(start)) < 1e-4);
}

TEST_CASE("cloth_contact: above it cloth slides as Coulomb's law says", "[dynamics]") {
  const char* const stepper = GENERATE("implicit", "xpbd");
  const double friction = GENERATE(0.0, 0.2, 0.6);
  LyingSquare lying(friction);
  const double angle = std::atan(1.2 * friction + 0.1);
  lying.tilt(angle);
  const Positions start = lying.state.positions;
  const int n_steps = 120;
  run(lying, stepper, n_steps);
  const double time = n_steps / 240.0;
  const double acceleration = kGravity * (std::sin(angle) - friction * std::cos(angle));
  CHECK(lying.way(start) == Approx(acceleration * time * time / 2).epsilon(0.02));
}

TEST_CASE("cloth_contact: without self-contact a stepper has none", "[dynamics]") {
  LyingSquare lying(0.3, 0.02);
  lying.model.self_contact.reset();
  const auto stepper = make_stepper(lying.model, method_of("implicit"));
  CHECK(stepper->cloth_contact() == nullptr);
  for (int s = 0; s < 60; ++s) stepper->advance(lying.state, s / 240.0);
  CHECK(lying.square().row(1).maxCoeff() < 0);
}

}  // namespace pleat
