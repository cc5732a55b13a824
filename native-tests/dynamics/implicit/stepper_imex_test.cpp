#include "core/dynamics/implicit/stepper_imex.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/dynamics/stepper_table.h"
#include "core/model/system_matrix.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

MethodOptions exact_method(const StepperType& type, double step) {
  MethodOptions options;
  options.stepper = &type;
  options.step = step;
  options.solver = SolverKind::supernodal;
  return options;
}

/// Vertices at random places, joined by springs at rest of very different stiffness.
ClothModel random_graph(std::uint64_t seed) {
  constexpr int kVertices = 14;
  Random random(seed);
  ClothModel model;
  model.masses = Eigen::VectorXd::NullaryExpr(
      kVertices, [&] { return 1e-3 * std::pow(10, random.uniform(-0.5, 0.5)); });
  for (int a = 0; a < kVertices; ++a)
    for (int b = a + 1; b < kVertices; ++b) {
      if (random.uniform(0, 1) < 0.7) continue;
      Spring spring{VertexId(a), VertexId(b)};
      spring.stiffness = std::pow(10, random.uniform(-1, 4));
      spring.damping = random.uniform(0, 1) < 0.5 ? 0 : 1e-4 * spring.stiffness;
      model.springs.push_back(spring);
    }
  return model;
}

Positions random_places(const ClothModel& model, std::uint64_t seed) {
  Random random(seed);
  return shaken(Positions::Zero(3, model.n_vertices()), 1, random);
}

void rest_at(const Positions& x, ClothModel& model) {
  for (Spring& spring : model.springs)
    spring.rest_length = (x.col(spring.a) - x.col(spring.b)).norm();
}

/// Spectral radius of one substep about the places, velocities and positions together:
///
///     dv = A^-1 h (-K x - C_E v - C_I v - h K_I v),  A = M + h C_I + h^2 K_I
double spectral_radius(const StabilitySplit& parts, const Positions& x, double h) {
  const auto K = [&](const ClothModel& model) {
    return dense(stiffness_matrix(model, x, ElementHessian::projected));
  };
  const Eigen::MatrixXd K_stiff = K(parts.stiff);
  const Eigen::MatrixXd K_soft = K(parts.soft);
  const Eigen::MatrixXd C_stiff = dense(damping_matrix(parts.stiff, x));
  const Eigen::MatrixXd C_soft = dense(damping_matrix(parts.soft, x));
  const Eigen::Index n = K_stiff.rows();
  const Eigen::MatrixXd M = dense(mass_matrix(parts.stiff));
  const Eigen::MatrixXd A_inverse = (M + h * C_stiff + h * h * K_stiff).inverse();
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd from_places = -h * A_inverse * (K_stiff + K_soft);
  const Eigen::MatrixXd from_velocities = I - h * A_inverse * (C_stiff + C_soft + h * K_stiff);
  Eigen::MatrixXd amplification(2 * n, 2 * n);
  amplification << I + h * from_places, h * from_velocities, from_places, from_velocities;
  return amplification.eigenvalues().cwiseAbs().maxCoeff();
}

/// The split with the softest of the stiff springs explicit as well.
StabilitySplit with_softest_explicit(StabilitySplit parts) {
  const auto softest =
      std::min_element(parts.stiff.springs.begin(), parts.stiff.springs.end(),
                       [](const Spring& a, const Spring& b) { return a.stiffness < b.stiffness; });
  parts.soft.springs.push_back(*softest);
  parts.stiff.springs.erase(softest);
  return parts;
}

ClothModel swinging_model(const QuadMesh& mesh,
                          const FabricConstants& fabric = library_fabric("fine cotton")) {
  ClothModel model = sheet_model(mesh, fabric);
  model.gravity = {0, -9.81, 0};
  for (const int v : {0, 2})
    model.pins.push_back({VertexId(v), mesh.rest_positions().col(v), Motion{}});
  return model;
}

State after(ClothModel model, const MethodOptions& options, const QuadMesh& mesh, int n_steps) {
  State state = rest_state(mesh);
  Random random(5);
  state.positions = shaken(state.positions, 0.01, random);
  for (const Pin& pin : model.pins) state.positions.col(pin.vertex) = pin.position(0);
  const auto stepper = make_stepper(model, options);
  for (int s = 0; s < n_steps; ++s) REQUIRE(stepper->advance(state, s * options.step).ok());
  return state;
}

}  // namespace

// A double pole at 1, of motion that nothing resists, is found to 1e-7 alone: its square root.
TEST_CASE("imex: what is explicit is stable, on any graph of springs", "[dynamics][long]") {
  constexpr double kStep = 2e-3;
  constexpr double kRounding = 1e-6;
  int n_mixed = 0, n_broken = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    ClothModel model = random_graph(seed);
    const Positions x = random_places(model, seed + 100);
    rest_at(x, model);
    // Stretched springs pull across as well, those that are squeezed do not push.
    for (const double scale : {1.0, 1.3, 0.8}) {
      const StabilitySplit parts = split_by_stability(model, kStep);
      CHECK(spectral_radius(parts, scale * x, kStep) <= 1 + kRounding);
      if (parts.stiff.springs.empty() || parts.soft.springs.empty()) continue;
      ++n_mixed;
      const double more = spectral_radius(with_softest_explicit(parts), scale * x, kStep);
      n_broken += more > 1 + kRounding ? 1 : 0;
    }
  }
  CHECK(n_mixed > 30);
  CHECK(n_broken > 3);
}

TEST_CASE("imex: shorter substeps leave more springs explicit", "[dynamics]") {
  const ClothModel model = swinging_model(square_sheet(9));
  std::size_t before = 0;
  for (const double h : {1.0 / 60, 5e-3, 2.5e-3, 1e-3, 1e-4, 1e-5}) {
    const StabilitySplit parts = split_by_stability(model, h);
    CAPTURE(h, parts.soft.springs.size(), parts.soft.bends.size());
    CHECK(parts.soft.springs.size() >= before);
    CHECK(parts.soft.springs.size() + parts.stiff.springs.size() == model.springs.size());
    CHECK(parts.soft.bends.size() + parts.stiff.bends.size() == model.bends.size());
    before = parts.soft.springs.size();
  }
  CHECK(before == model.springs.size());
}

TEST_CASE("imex: with all springs stiff it is implicit, with none symplectic Euler", "[dynamics]") {
  const QuadMesh mesh = square_sheet(4);
  const ClothModel model = swinging_model(mesh);
  constexpr double kLong = 100;
  REQUIRE(split_by_stability(model, kLong).soft.springs.empty());
  REQUIRE(split_by_stability(model, kLong).soft.bends.empty());
  const auto far = [&](const StepperType& type, double step) {
    return (after(model, exact_method(steppers::kImex, step), mesh, 3).positions -
            after(model, exact_method(type, step), mesh, 3).positions)
        .cwiseAbs()
        .maxCoeff();
  };
  CHECK(far(steppers::kImplicitEuler, kLong) < 1e-9);
  constexpr double kShort = 1e-5;
  REQUIRE(split_by_stability(model, kShort).stiff.springs.empty());
  CHECK(far(steppers::kExplicitEuler, kShort) < 1e-12);
}

TEST_CASE("imex: its error falls with the first power of the step", "[dynamics]") {
  const QuadMesh mesh = square_sheet(4);
  const ClothModel model = swinging_model(mesh, soft_fabric());
  constexpr double kTime = 0.04;
  MethodOptions reference = exact_method(steppers::kRk4, kTime / 8);
  reference.substeps = 0;
  const Positions expected = after(model, reference, mesh, 8).positions;
  const auto error = [&](int n_steps) {
    MethodOptions options = exact_method(steppers::kImex, kTime / n_steps);
    // The set of one step length, so that the equations are alike.
    options.split = ImplicitSplit::structural;
    return (after(model, options, mesh, n_steps).positions - expected).norm();
  };
  const double coarse = error(400);
  const double fine = error(800);
  CAPTURE(coarse, fine);
  CHECK(std::log2(coarse / fine) == Approx(1).margin(0.25));
}

TEST_CASE("imex: structural springs alone are implicit where that is asked for", "[dynamics]") {
  ClothModel model = swinging_model(square_sheet(4));
  std::size_t n_soft = 0;
  for (const Spring& spring : model.springs) n_soft += spring.kind == SpringKind::shear ? 1 : 0;
  model.springs.push_back({VertexId(0), VertexId(2), 1, 0.5, 0, SpringKind::bend});
  model.springs.push_back({VertexId(0), VertexId(3), 1, 0.5, 0, SpringKind::other});
  const StabilitySplit parts = split_structural(model);
  CHECK(parts.soft.springs.size() == n_soft + 1);
  CHECK(parts.soft.springs.back().kind == SpringKind::bend);
  CHECK(parts.stiff.springs.back().kind == SpringKind::other);
  CHECK(parts.stiff.springs.size() + parts.soft.springs.size() == model.springs.size());
  CHECK(parts.stiff.bends.empty());
  CHECK(parts.soft.bends.size() == model.bends.size());
}

TEST_CASE("imex: it tells which springs are implicit, again after the pins changed", "[dynamics]") {
  ClothModel model = swinging_model(square_sheet(9));
  const auto stepper = make_stepper(model, exact_method(steppers::kImex, 2.5e-3));
  const auto told = [&] {
    const std::span<const char> is_implicit = stepper->implicit_springs();
    return std::vector<char>(is_implicit.begin(), is_implicit.end());
  };
  const std::vector<char> before = told();
  CHECK(before == split_by_stability(model, 2.5e-3).is_stiff);
  CHECK(std::count(before.begin(), before.end(), char{0}) > 0);
  CHECK(std::count(before.begin(), before.end(), char{1}) > 0);
  model.pins.clear();
  stepper->refresh();
  CHECK(told() == split_by_stability(model, 2.5e-3).is_stiff);
  CHECK(told() != before);
}

TEST_CASE("imex: it takes the fewest substeps that make the wanted share explicit", "[dynamics]") {
  ClothModel model = swinging_model(square_sheet(9));
  MethodOptions options = exact_method(steppers::kImex, 1.0 / 60);
  const auto share = [&](int substeps) { return explicit_share(model, options.step / substeps); };
  for (const double wanted : {0.2, 0.5, 0.9, 1.0}) {
    options.explicit_share = wanted;
    const int substeps = make_stepper(model, options)->substeps();
    CAPTURE(wanted, substeps);
    CHECK(imex_substeps(model, options) == substeps);
    CHECK(share(substeps) >= wanted);
    CHECK(share(substeps - 1) < wanted);
  }
  options.explicit_share = 0.2;
  options.substeps = 1000;
  CHECK(make_stepper(model, options)->substeps() == 1000);
}

TEST_CASE("imex: a share that no substeps reach, or none can change, is refused", "[dynamics]") {
  ClothModel model = swinging_model(square_sheet(3));
  MethodOptions options = exact_method(steppers::kImex, 1.0 / 60);
  options.explicit_share = 1;
  model.springs[0].stiffness = 1e15;
  CHECK_THROWS_WITH(make_stepper(model, options), Catch::Contains("got one that needs more"));
  options.split = ImplicitSplit::structural;
  CHECK_THROWS_WITH(make_stepper(model, options), Catch::Contains("structural"));
}

TEST_CASE("imex: other steppers treat all springs alike", "[dynamics]") {
  ClothModel model = swinging_model(square_sheet(3));
  for (const MethodOptions& options : everyday_methods())
    if (options.stepper != &steppers::kImex)
      CHECK(make_stepper(model, options)->implicit_springs().empty());
}

TEST_CASE("imex: sor, cg and a factor come to the same", "[dynamics]") {
  const QuadMesh mesh = square_sheet(6);
  const ClothModel model = swinging_model(mesh);
  const auto end = [&](SolverKind kind) {
    MethodOptions options = exact_method(steppers::kImex, 2.5e-3);
    options.solver = kind;
    options.tolerance = 1e-11;
    return after(model, options, mesh, 40).positions;
  };
  const Positions exact = end(SolverKind::supernodal);
  CHECK((end(SolverKind::sor) - exact).cwiseAbs().maxCoeff() < 1e-8);
  CHECK((end(SolverKind::cg) - exact).cwiseAbs().maxCoeff() < 1e-8);
}

}  // namespace pleat
