#include "core/reference/closed_forms.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/base/check.h"
#include "core/base/random.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/models.h"

using namespace pleat;

namespace {

Cantilever strip_with_load(double load) {
  Cantilever strip;
  strip.length = 0.3;
  strip.rigidity = 2e-5;
  strip.weight = load * strip.rigidity / std::pow(strip.length, 3);
  return strip;
}

/// The free end's place, in units of the length.
Eigen::Vector2d elastica_tip(double load) {
  const Cantilever strip = strip_with_load(load);
  const double tip[] = {strip.length};
  return heavy_elastica(strip, tip).col(0) / strip.length;
}

/// Tip of n rigid links of length 1/n joined by hinges of stiffness n, `clamp` at the first, where
/// least energy holds them against a load; below the horizontal that energy is convex in the
/// angles.
Eigen::Vector2d linked_tip(double load, int n, double clamp) {
  constexpr double kLargestStep = 0.5;  // [rad]
  Eigen::VectorXd angles = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd step;
  Eigen::MatrixXd hinges = Eigen::MatrixXd::Zero(n, n);
  hinges(0, 0) = clamp;
  for (int i = 1; i < n; ++i)
    hinges.block<2, 2>(i - 1, i - 1) += n * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
  Eigen::VectorXd weights(n);  // moment of the weight per sine of the angle
  for (int i = 0; i < n; ++i) weights[i] = load / (n * n) * (n - i - 0.5);
  do {
    const Eigen::VectorXd gradient =
        hinges * angles - weights.cwiseProduct(angles.array().cos().matrix());
    Eigen::MatrixXd hessian = hinges;
    hessian.diagonal() += weights.cwiseProduct(angles.array().sin().matrix());
    step = -hessian.ldlt().solve(gradient);
    step *= std::min(1.0, kLargestStep / step.cwiseAbs().maxCoeff());
    angles += step;
  } while (step.norm() > 1e-12);
  return {angles.array().cos().mean(), angles.array().sin().mean()};
}

std::vector<ChainLink> equal_links(const Rope& rope, int n) {
  const double length = rope.length / n;
  return std::vector<ChainLink>(static_cast<std::size_t>(n),
                                {length, 1 / (rope.compliance * length), rope.weight * length});
}

}  // namespace

TEST_CASE("closed_forms: a light strip sinks as a beam and shortens as its slope says",
          "[reference]") {
  const double load = GENERATE(1e-3, 1e-2);
  const Eigen::Vector2d tip = elastica_tip(load);
  CHECK(tip.y() == Approx(load / 8).epsilon(load * load));
  CHECK(1 - tip.x() == Approx(load * load / 112).epsilon(load * load));
}

// Near the clamp a heavy strip is a taut string with rigidity: it turns down over sqrt(B/(w L)),
// and reaches sqrt(2 B/(w L)) = L sqrt(2/load) outwards.
TEST_CASE("closed_forms: a heavy strip reaches out as its boundary layer does", "[reference]") {
  std::vector<double> differences;
  for (const double load : {1e4, 4e4, 1.6e5})
    differences.push_back(elastica_tip(load).x() * std::sqrt(load / 2) - 1);
  CHECK(std::abs(differences[2]) < 3e-3);
  CHECK(differences[0] / differences[1] == Approx(2).epsilon(0.05));
  CHECK(differences[1] / differences[2] == Approx(2).epsilon(0.05));
}

TEST_CASE("closed_forms: a chain of rigid links converges to the elastica at second order",
          "[reference]") {
  const double load = GENERATE(1.0, 10.0, 100.0, 1000.0);
  CAPTURE(load);
  const Eigen::Vector2d tip = elastica_tip(load);
  const Eigen::Vector2d coarse = linked_tip(load, 80, 160);
  const Eigen::Vector2d fine = linked_tip(load, 160, 320);
  CHECK((coarse - tip).norm() / (fine - tip).norm() == Approx(4).epsilon(0.02));
  CHECK(((4 * fine - coarse) / 3 - tip).norm() < 5e-6);
}

// Two held rows of a mesh are such a clamp.
TEST_CASE("closed_forms: clamped by a hinge like the others, links begin half a link earlier",
          "[reference]") {
  const double load = GENERATE(1.0, 10.0, 100.0);
  CAPTURE(load);
  std::vector<double> errors;
  for (const int n : {40, 80, 160}) {
    Cantilever strip;
    strip.length = 1 + 0.5 / n;
    strip.weight = load;
    const double tip[] = {strip.length};
    const Eigen::Vector2d exact = heavy_elastica(strip, tip).col(0) - Eigen::Vector2d(0.5 / n, 0);
    errors.push_back((linked_tip(load, n, n) - exact).norm());
  }
  CHECK(errors[0] / errors[1] == Approx(4).epsilon(0.06));
  CHECK(errors[1] / errors[2] == Approx(4).epsilon(0.06));
}

// The slope of the testers of ASTM D1388 and BS 3356 (Peirce 1930): a strip that just reaches it
// overhangs by twice its bending length (B/w)^(1/3).
TEST_CASE("closed_forms: at twice the bending length the chord drops by 41.5 degrees",
          "[reference]") {
  const Eigen::Vector2d tip = elastica_tip(8);
  CHECK(std::atan2(tip.y(), tip.x()) * 180 / kPi == Approx(41.5).margin(0.05));
}

TEST_CASE("closed_forms: the elastica keeps its length and starts level at the clamp",
          "[reference]") {
  const Cantilever strip = strip_with_load(GENERATE(0.0, 3.0, 1000.0, kMaxCantileverLoad));
  constexpr int kPieces = 20000;
  std::vector<double> arc_lengths;
  for (int i = 0; i <= kPieces; ++i) arc_lengths.push_back(strip.length * i / kPieces);
  const Eigen::Matrix2Xd shape = heavy_elastica(strip, arc_lengths);
  CHECK(shape.col(0).norm() == 0);
  const double edge = strip.length / kPieces;
  CHECK(shape(0, 1) == Approx(edge).epsilon(1e-3));
  const Eigen::Matrix2Xd edges = shape.rightCols(kPieces) - shape.leftCols(kPieces);
  // A chord over a curvature of at most sqrt(2 load)/L is shorter by (curvature edge)^2/24.
  const double shortening = strip.load() / (12.0 * kPieces * kPieces);
  for (int i = 0; i < kPieces; ++i)
    REQUIRE(edges.col(i).norm() == Approx(edge).epsilon(1e-9 + 1.1 * shortening));
}

TEST_CASE("closed_forms: an elastica beyond what its angles can hold is refused", "[reference]") {
  CHECK_THROWS_AS(elastica_tip(1.1 * kMaxCantileverLoad), ContractError);
}

// A piece of the curve y = cosh x, whose arc length is sinh x.
TEST_CASE("closed_forms: an inextensible rope hangs as a hyperbolic cosine", "[reference]") {
  const auto [begin, end] =
      GENERATE(std::pair(-1.0, 1.0), std::pair(-0.01, 0.01), std::pair(-5.0, 5.0),
               std::pair(-0.5, 2.0), std::pair(1.0, 3.0), std::pair(-3.0, -2.9));
  CAPTURE(begin, end);
  Rope rope;
  rope.length = std::sinh(end) - std::sinh(begin);
  rope.weight = 0.7;
  std::vector<double> arc_lengths;
  for (int i = 0; i <= 10; ++i) arc_lengths.push_back(rope.length * i / 10);
  const auto shape = catenary(rope, {end - begin, std::cosh(begin) - std::cosh(end)}, arc_lengths);
  REQUIRE(shape);
  for (std::size_t i = 0; i < arc_lengths.size(); ++i) {
    const double x = std::asinh(std::sinh(begin) + arc_lengths[i]);
    const Eigen::Vector2d exact(x - begin, std::cosh(begin) - std::cosh(x));
    CHECK((shape->col(static_cast<Eigen::Index>(i)) - exact).norm() < 1e-9 * rope.length);
  }
}

TEST_CASE("closed_forms: a chain of springs converges to the elastic rope at second order",
          "[reference]") {
  Rope rope;
  rope.length = 1.2;
  rope.weight = 3;
  rope.compliance = 0.1;
  const Eigen::Vector2d far_support =
      GENERATE(Eigen::Vector2d(0.8, 0), Eigen::Vector2d(0.5, 0.9), Eigen::Vector2d(2, -0.6));
  const double middle[] = {rope.length / 2};
  const auto exact = catenary(rope, far_support, middle);
  REQUIRE(exact);
  std::vector<double> errors;
  for (const int n : {20, 40, 80}) {
    const auto nodes = chain_between_supports(equal_links(rope, n), far_support);
    REQUIRE(nodes);
    errors.push_back((nodes->col(n / 2) - exact->col(0)).norm());
  }
  CHECK(errors[0] / errors[1] == Approx(4).epsilon(0.05));
  CHECK(errors[1] / errors[2] == Approx(4).epsilon(0.05));
}

TEST_CASE("closed_forms: springs and weight balance at every node of a chain", "[reference]") {
  Random random(GENERATE(1, 2, 3, 4, 5));
  std::vector<ChainLink> links;
  links.reserve(12);
  for (int i = 0; i < 12; ++i)
    links.push_back({random.uniform(0, 0.2), random.uniform(5, 500), random.uniform(0.01, 1)});
  const Eigen::Vector2d far_support(random.uniform(0.1, 2.0), random.uniform(-1.0, 1.0));
  const auto nodes = chain_between_supports(links, far_support);
  REQUIRE(nodes);
  CHECK((nodes->col(12) - far_support).norm() < 1e-11);
  const auto tension = [&](std::size_t i) {
    const Eigen::Vector2d edge =
        nodes->col(static_cast<Eigen::Index>(i) + 1) - nodes->col(static_cast<Eigen::Index>(i));
    return Eigen::Vector2d(links[i].stiffness * (edge.norm() - links[i].length) *
                           edge.normalized());
  };
  for (std::size_t i = 0; i + 1 < links.size(); ++i)
    CHECK((tension(i + 1) - tension(i) + Eigen::Vector2d(0, links[i].weight)).norm() < 1e-9);
}

TEST_CASE("closed_forms: ropes that cannot be are refused", "[reference]") {
  const double ends[] = {0, 1};
  CHECK_THROWS_AS(catenary({1, 1, 0}, {1.01, 0}, ends), ContractError);
  CHECK_THROWS_AS(catenary({1, 1, 0}, {0, 0.5}, ends), ContractError);
  CHECK_THROWS_AS(chain_between_supports(std::vector<ChainLink>{{1, 1, 1}}, {1, 0}), ContractError);
}

TEST_CASE("closed_forms: each spring of a hanging chain carries what is below it", "[reference]") {
  const Chain chain;
  std::vector<ChainLink> links(static_cast<std::size_t>(chain.n_springs),
                               {chain.length, chain.stiffness, chain.mass * chain.gravity});
  links.back().weight /= 2;
  const Eigen::VectorXd depths = hanging_chain(links);
  const Eigen::VectorXd balanced = -hanging_state(chain).positions.row(1).transpose();
  CHECK((depths - balanced).norm() < 1e-14);
  CHECK(
      depths[chain.n_springs] - chain.n_springs * chain.length ==
      Approx(spring_chain_elongation(chain.n_springs, chain.stiffness, chain.mass, chain.gravity)));
}

TEST_CASE("closed_forms: at every depth a hanging strip's law carries what is below",
          "[reference]") {
  HangingStrip strip;
  strip.length = 0.8;
  strip.stiffness = 50;
  strip.law = GENERATE(StretchLaw::hooke, StretchLaw::green);
  // The cubic of the St. Venant-Kirchhoff law changes branch at w L = 0.19 K.
  strip.weight = GENERATE(0.0, 1e-4, 1.0, 11.9, 12.1, 500.0);
  CAPTURE(strip.weight);
  CHECK(hanging_depth(strip, 0) == 0);
  for (const double u : {0.1, 0.35, 0.7}) {
    constexpr double kStep = 1e-5;
    const double f =
        (hanging_depth(strip, u + kStep) - hanging_depth(strip, u - kStep)) / (2 * kStep);
    const double n = strip.law == StretchLaw::hooke ? strip.stiffness * (f - 1)
                                                    : f * strip.stiffness * (f * f - 1) / 2;
    CHECK(n == Approx(strip.weight * (strip.length - u)).epsilon(1e-8).margin(1e-8));
  }
}

TEST_CASE("closed_forms: a hanging strip of springs lengthens by w L^2/(2 K)", "[reference]") {
  HangingStrip strip{0.8, 2, 50, StretchLaw::hooke};
  CHECK(hanging_depth(strip, 0.8) - 0.8 == Approx(2 * 0.64 / 100).epsilon(1e-13));
}
