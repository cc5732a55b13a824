#include "core/dynamics/position_based/lanes/bend_program.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "core/base/random.h"
#include "native-tests/support/graded_sheets.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr double kBendStep = 1e-3;  // [s]

/// Bent threads without springs: elements of three places, of unequal weights, and masses.
struct BentThreads {
  ClothModel model;
  Positions begins, moves;
  std::vector<bool> is_held;

  BentThreads(int n_vertices, std::uint64_t seed) : is_held(static_cast<std::size_t>(n_vertices)) {
    Random random(seed);
    model.masses.resize(n_vertices);
    begins.resize(3, n_vertices);
    moves.resize(3, n_vertices);
    for (int i = 0; i < n_vertices; ++i) {
      model.masses[i] = random.uniform(0.5, 2);
      for (int k = 0; k < 3; ++k) {
        begins(k, i) = static_cast<float>(random.uniform(-0.02, 0.02));
        moves(k, i) = static_cast<float>(random.uniform(-0.001, 0.001));
      }
    }
    for (int i = 0; i < n_vertices; i += 7) is_held[static_cast<std::size_t>(i)] = true;
  }

  /// compliance  about mean mass / (stiffness h^2)
  void bend(int a, int b, int c, double share, double compliance) {
    BendElement element;
    element.vertices = {VertexId(a), VertexId(b), VertexId(c)};
    element.weights = {share, -1, 1 - share};
    element.stiffness = 1 / (compliance * kBendStep * kBendStep);
    model.bends.push_back(element);
  }

  /// How far one solve of all elements together moves the vertices, W J^T lambda with
  /// (J W J^T + alpha) lambda = -J x: in double precision and without any order.
  Positions solved_together() const {
    const auto n = model.n_vertices();
    const auto n_bends = static_cast<Eigen::Index>(model.bends.size());
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(n_bends, n);
    Eigen::VectorXd compliance(n_bends);
    for (Eigen::Index e = 0; e < n_bends; ++e) {
      const BendElement& bend = model.bends[static_cast<std::size_t>(e)];
      for (std::size_t k = 0; k < 3; ++k)
        jacobian(e, bend.vertices[k].value) = bend.weights[k] / std::abs(bend.weights[1]);
      compliance[e] = model.masses.mean() /
                      (bend.stiffness * bend.weights[1] * bend.weights[1] * kBendStep * kBendStep);
    }
    Eigen::VectorXd inverse_masses = model.masses.mean() * model.masses.cwiseInverse();
    for (int i = 0; i < n; ++i)
      if (is_held[static_cast<std::size_t>(i)]) inverse_masses[i] = 0;
    Eigen::MatrixXd system = jacobian * inverse_masses.asDiagonal() * jacobian.transpose();
    system += compliance.asDiagonal();
    const Eigen::MatrixXd multipliers =
        -system.llt().solve(jacobian * (begins + moves).transpose());
    return (inverse_masses.asDiagonal() * jacobian.transpose() * multipliers).transpose();
  }
};

/// A program's moves of threads, and what it leaves of their errors.
struct SweptThreads {
  LaneLayout layout;
  BendProgram program;
  std::vector<float> numbers;

  explicit SweptThreads(const BentThreads& threads)
      : layout(lane_layout(threads.model)), program(threads.model, layout, kBendStep) {
    numbers.assign(7 * size(), 0.0f);
    for (int i = 0; i < threads.model.n_vertices(); ++i) {
      for (int k = 0; k < 3; ++k) {
        at(k, i) = static_cast<float>(threads.moves(k, i));
        at(3 + k, i) = static_cast<float>(threads.begins(k, i));
      }
      if (!threads.is_held[static_cast<std::size_t>(i)])
        at(6, i) = static_cast<float>(threads.model.masses.mean() / threads.model.masses[i]);
    }
    program.refresh_pins(view().inverse_masses);
  }

  std::size_t size() const { return static_cast<std::size_t>(layout.n_slots); }
  float& at(int array, int vertex) {
    return numbers[static_cast<std::size_t>(array) * size() +
                   static_cast<std::size_t>(layout.places[static_cast<std::size_t>(vertex)].slot)];
  }
  LaneView view() {
    float* const first = numbers.data();
    const auto array = [&](std::size_t which) { return first + which * size(); };
    return {{array(0), array(1), array(2)}, {array(3), array(4), array(5)}, array(6)};
  }
  Positions moved(const BentThreads& threads) {
    Positions by(3, threads.model.n_vertices());
    for (int i = 0; i < threads.model.n_vertices(); ++i)
      for (int k = 0; k < 3; ++k) by(k, i) = at(k, i) - threads.moves(k, i);
    return by;
  }
};

/// Single precision loses digits where the compliance is small against the sum of inverse masses.
void check_solved_at_once(const BentThreads& threads) {
  SweptThreads swept(threads);
  const double before = swept.program.squared_residual(swept.view());
  swept.program.sweep(swept.view(), Multipliers::begun);
  const Positions expected = threads.solved_together();
  CHECK((swept.moved(threads) - expected).cwiseAbs().maxCoeff() <
        1e-4 * expected.cwiseAbs().maxCoeff());
  CHECK(swept.program.squared_residual(swept.view()) < 1e-9 * before);
  SweptThreads passing(threads);
  passing.program.sweep(passing.view(), Multipliers::passing);
  CHECK(passing.numbers == swept.numbers);
}

/// Vertices row by row, numbered by chance.
std::vector<int> chance_numbers(int count, std::uint64_t seed) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  Random random(seed);
  for (std::size_t i = numbers.size(); i > 1; --i)
    std::swap(numbers[i - 1],
              numbers[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(i)))]);
  return numbers;
}

}  // namespace

TEST_CASE("bend program: all elements of a thread are solved at once", "[dynamics]") {
  const int n = GENERATE(3, 4, 5, 12, 65);
  const double compliance = GENERATE(1.0, 1e-2, 1e-4);
  CAPTURE(n, compliance);
  BentThreads threads(n, 5);
  for (int i = 0; i + 2 < n; ++i) {
    const bool turned = i % 3 == 0;  // an element says nothing of the thread's direction
    threads.bend(turned ? i + 2 : i, i + 1, turned ? i : i + 2, i % 2 == 0 ? 0.5 : 0.4,
                 (1 + i % 2) * compliance);
  }
  check_solved_at_once(threads);
}

TEST_CASE("bend program: so are those of all threads side by side, wherever they run",
          "[dynamics]") {
  const int n_rows = GENERATE(3, 9, 14);
  const int n_columns = GENERATE(4, 13);
  const bool along_rows = GENERATE(false, true);
  const bool has_grid = GENERATE(false, true);
  CAPTURE(n_rows, n_columns, along_rows, has_grid);
  BentThreads threads(n_rows * n_columns, 6);
  const std::vector<int> numbers = chance_numbers(n_rows * n_columns, 7);
  const auto vertex = [&](int r, int c) {
    return numbers[static_cast<std::size_t>(r * n_columns + c)];
  };
  if (has_grid) threads.model.rest_coordinates.resize(2, n_rows * n_columns);
  for (int r = 0; r < n_rows; ++r)
    for (int c = 0; c < n_columns; ++c) {
      if (has_grid) threads.model.rest_coordinates.col(vertex(r, c)) << r, c;
      if (along_rows && c + 2 < n_columns)
        threads.bend(vertex(r, c), vertex(r, c + 1), vertex(r, c + 2), 0.5, 0.01);
      if (!along_rows && r + 2 < n_rows)
        threads.bend(vertex(r, c), vertex(r + 1, c), vertex(r + 2, c), 0.5, 0.01);
    }
  check_solved_at_once(threads);
}

TEST_CASE("bend program: sweeps over crossing threads and rings come to the common solution",
          "[dynamics]") {
  const bool closes = GENERATE(false, true);
  const int n = GENERATE(3, 4, 9);
  CAPTURE(closes, n);
  BentThreads threads(n * n, 8);
  const auto vertex = [&](int r, int c) { return (r % n) * n + c % n; };
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      if (closes || c + 2 < n)
        threads.bend(vertex(r, c), vertex(r, c + 1), vertex(r, c + 2), 0.5, 0.3);
      if (closes || r + 2 < n)
        threads.bend(vertex(r, c), vertex(r + 1, c), vertex(r + 2, c), 0.5, 0.3);
    }
  SweptThreads swept(threads);
  for (int sweep = 0; sweep < 60; ++sweep)
    swept.program.sweep(swept.view(), sweep == 0 ? Multipliers::begun : Multipliers::kept);
  const Positions expected = threads.solved_together();
  CHECK((swept.moved(threads) - expected).cwiseAbs().maxCoeff() <
        1e-5 * expected.cwiseAbs().maxCoeff());
}

TEST_CASE("bend program: four lanes together give what they give one by one, to the bit",
          "[dynamics]") {
  const int n = GENERATE(4, 9, 14, 33);
  BentThreads threads(n * n, 9);
  threads.model.rest_coordinates.resize(2, n * n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      threads.model.rest_coordinates.col(r * n + c) << r, c;
      if (c + 2 < n) threads.bend(r * n + c, r * n + c + 1, r * n + c + 2, 0.5, 0.01);
      if (r + 2 < n && c % 5 != 3)
        threads.bend(r * n + c, (r + 1) * n + c, (r + 2) * n + c, 0.45, 0.01);
    }
  SweptThreads together(threads);
  SweptThreads apart(threads);
  apart.program.compute_lane_by_lane();
  for (int sweep = 0; sweep < 4; ++sweep) {
    together.program.sweep(together.view(), sweep == 0 ? Multipliers::begun : Multipliers::kept);
    apart.program.sweep(apart.view(), sweep == 0 ? Multipliers::begun : Multipliers::kept);
  }
  CHECK(together.numbers == apart.numbers);
}

TEST_CASE("bend program: elements beside hanging vertices are left to others", "[dynamics]") {
  const QuadMesh mesh = graded_sheet(3);
  const ClothModel model = sheet_model(mesh, soft_fabric());
  REQUIRE_FALSE(model.hanging.empty());
  const std::vector<BendConstraint> bends = bend_constraints(model, kBendStep);
  std::vector<bool> is_taken(bends.size(), false);
  for (const BendChain& chain : bend_chains(model, bends)) {
    REQUIRE(chain.vertices.size() == chain.bends.size() + 2);
    for (std::size_t i = 0; i < chain.bends.size(); ++i) {
      const auto element = static_cast<std::size_t>(chain.bends[i].element);
      CHECK_FALSE(is_taken[element]);
      is_taken[element] = true;
      CHECK(chain.vertices[i + 1] == bends[element].vertices[1]);
    }
  }
  for (std::size_t e = 0; e < bends.size(); ++e)
    CHECK(is_taken[e] != any_hangs(model, bends[e].vertices));
}

}  // namespace pleat
