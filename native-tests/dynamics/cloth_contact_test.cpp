#include "core/dynamics/cloth_contact.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string_view>

#include "core/dynamics/stepper_table.h"
#include "core/model/energy_ledger.h"
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

/// Appends a vertex to a model and its state.
VertexId add_vertex(ClothModel& model, State& state, const Vec3& place,
                    const Vec3& velocity = {0, 0, 0}) {
  const Eigen::Index n = state.positions.cols();
  state.positions.conservativeResize(3, n + 1);
  state.velocities.conservativeResize(3, n + 1);
  state.positions.col(n) = place;
  state.velocities.col(n) = velocity;
  model.masses.conservativeResize(n + 1);
  model.masses[n] = 1e-3;
  return VertexId(n);
}

/// Appends a square of two faces that lies level and is turned about its centre.
///
/// edge  [m]; angle  [rad]
std::array<VertexId, 4> add_level_square(ClothModel& model, State& state, const Vec3& centre,
                                         double edge, double angle, double stiffness,
                                         const Vec3& velocity = {0, 0, 0}) {
  constexpr double kQuarter = 1.5707963267948966;
  std::array<VertexId, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const double turn = angle + kQuarter * static_cast<double>(k);
    const Vec3 out(std::cos(turn), 0, std::sin(turn));
    corners[k] = add_vertex(model, state, centre + edge / std::sqrt(2.0) * out, velocity);
    for (std::size_t m = 0; m < k; ++m) {
      const Vec3 side = state.positions.col(corners[k]) - state.positions.col(corners[m]);
      model.springs.push_back({corners[m], corners[k], stiffness, side.norm()});
    }
  }
  model.self_contact->faces.push_back({corners[0], corners[1], corners[2]});
  model.self_contact->faces.push_back({corners[0], corners[2], corners[3]});
  model.self_contact->rest_positions = state.positions;
  return corners;
}

/// Two squares without weight that fly at each other, turned against each other.
struct MeetingSquares {
  ClothModel model;
  State state;

  MeetingSquares() {
    model.self_contact.emplace();
    model.self_contact->thickness = kThickness;
    model.self_contact->friction = 0.3;
    model.gravity.setZero();
    const Vec3 common(0.3, 0.2, -0.1);
    add_square(Vec3(0, 0, 0), 0.1, common + Vec3(0, 0.4, 0));
    add_square(Vec3(0, 0.03, 0), 0.7, common - Vec3(0, 0.4, 0));
  }
  void add_square(const Vec3& centre, double angle, const Vec3& velocity) {
    add_level_square(model, state, centre, 0.1, angle, 50, velocity);
  }
  Vec3 momentum() const { return state.velocities * model.masses; }
  /// Speed at which the second comes towards the first [m/s].
  double approach() const {
    return state.velocities.row(1).head(4).mean() - state.velocities.row(1).segment(4, 4).mean();
  }
};

bool is_single_precision(std::string_view stepper) {
  return stepper == "xpbd" || stepper == "pbd" || stepper == "hpbd" || stepper == "multigrid";
}

/// A square that hangs from four stiff threads, on which another one falls.
struct Tray {
  static constexpr double kStiffness = 5e3;  // threads' [N/m]
  static constexpr double kLength = 0.3;     // [m]
  ClothModel model;
  State state;

  Tray() {
    model.self_contact.emplace();
    model.self_contact->thickness = kThickness;
    model.self_contact->friction = 0.3;
    model.gravity = {0, -kGravity, 0};
    for (const VertexId corner : add_level_square(model, state, {0, 0, 0}, 0.2, 0, 1e4)) {
      const Vec3 hook = state.positions.col(corner) + Vec3(0, kLength, 0);
      const VertexId pin = add_vertex(model, state, hook);
      model.springs.push_back({corner, pin, kStiffness, kLength});
      model.pins.push_back({pin, hook, {}});
    }
    add_level_square(model, state, {0, 0.02, 0}, 0.1, 0.4, 1e4);
  }
  Eigen::ArrayXd extensions() const {
    Eigen::ArrayXd found(4);
    for (int k = 0; k < 4; ++k)
      found[k] =
          (state.positions.col(k) - model.pins[static_cast<std::size_t>(k)].place).norm() - kLength;
    return found;
  }
  double longest_extension() const { return extensions().maxCoeff(); }
  double mean_extension() const { return extensions().mean(); }
  double extension_at_rest() const { return 8 * model.masses[0] * kGravity / (4 * kStiffness); }
  double load_height() const {
    return state.positions.row(1).tail(4).mean() - state.positions.row(1).head(4).mean();
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

TEST_CASE("cloth_contact: sheets that meet in flight keep their momentum", "[dynamics]") {
  for (const StepperType* type : standard_steppers()) {
    INFO(type->name);
    MeetingSquares squares;
    MethodOptions method = method_of(type->name);
    if (type->has_stability_bound) method.substeps = kStableSubsteps;
    const auto stepper = make_stepper(squares.model, method);
    const Vec3 momentum = squares.momentum();
    const double approach = squares.approach();
    const double rounding = is_single_precision(type->name) ? 1e-8 : 1e-12;  // [N s]
    for (int s = 0; s < 48; ++s) {
      REQUIRE_FALSE(stepper->advance(squares.state, s / 240.0).ends_run());
      REQUIRE((squares.momentum() - momentum).norm() < rounding);
    }
    CHECK(squares.approach() < 0.05 * approach);
    CHECK(stepper->cloth_contact()->sums().n_held == 0);
  }
}

TEST_CASE("cloth_contact: threads carry in the solve what lies on their cloth", "[dynamics]") {
  const char* const stepper_name = GENERATE("implicit", "imex", "newton");
  Tray tray;
  MethodOptions method = method_of(stepper_name);
  method.step = 1.0 / 60;
  const auto stepper = make_stepper(tray.model, method);
  double longest = 0;
  for (int s = 0; s < 120; ++s) {
    REQUIRE_FALSE(stepper->advance(tray.state, s / 60.0).ends_run());
    longest = std::max(longest, tray.longest_extension());
  }
  CHECK(tray.load_height() == Approx(kThickness).epsilon(0.02));
  CHECK(tray.mean_extension() == Approx(tray.extension_at_rest()).epsilon(0.05));
  // Impulses alone give the tray half of the load's way in a step, 5 mm.
  CHECK(longest < 0.5e-3);
}

TEST_CASE("cloth_contact: cloth far away changes nothing, to the bit", "[dynamics]") {
  const char* const stepper_name = GENERATE("explicit", "rk4");
  MeetingSquares near_ones;
  MeetingSquares all;
  all.add_square(Vec3(50, 3, -20), 0, Vec3(0, 0.1, 0));
  MethodOptions method = method_of(stepper_name);
  method.substeps = 20;
  const auto stepper = make_stepper(near_ones.model, method);
  const auto with_far = make_stepper(all.model, method);
  for (int s = 0; s < 48; ++s) {
    stepper->advance(near_ones.state, s / 240.0);
    with_far->advance(all.state, s / 240.0);
  }
  CHECK(all.state.positions.leftCols(8) == near_ones.state.positions);
  CHECK(all.state.velocities.leftCols(8) == near_ones.state.velocities);
}

// Level squares that stop each other lose what reduced mass moved: 2 g at 0.8 m/s.
TEST_CASE("cloth_contact: a ledger accounts for what an impact takes", "[dynamics]") {
  const char* const stepper_name = GENERATE("implicit", "rk4", "xpbd");
  MeetingSquares squares;
  MethodOptions method = method_of(stepper_name);
  method.step = 1.0 / 960;
  method.substeps = 4;
  const auto stepper = make_stepper(squares.model, method);
  EnergyLedger ledger(squares.model, squares.state);
  for (int s = 0; s < 192; ++s) {
    const State begin = squares.state;
    stepper->advance(squares.state, s / 960.0);
    ledger.record(begin, squares.state, (s + 1) / 960.0, method.step,
                  stepper->cloth_contact()->pressed());
  }
  const double lost = 0.5 * 2e-3 * 0.8 * 0.8;
  CHECK(ledger.works().cloth_contact == Approx(-lost).epsilon(0.02));
  CHECK(std::abs(ledger.drift()) < 0.02 * lost);
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
