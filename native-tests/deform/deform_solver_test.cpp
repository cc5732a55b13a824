#include "core/deform/deform_solver.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/deform/fabric_weights.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/finite_difference.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

constexpr double kSide = 0.4;    // [m]
constexpr int kFarAhead = 1000;  // linearisations: as many as it takes
constexpr DeformWeights kCanvas = {0.23, 0.03, 0.74};
constexpr DeformWeights kCotton = {0.69, 0.31, 8e-5};  // hardly resists bending
constexpr DeformWeights kSilk = {0.98, 1e-4, 0.02};
constexpr DeformWeights kLinen = {1e-4, 0.13, 0.87};
constexpr DeformWeights kPlaceless = {0, 0.5, 0.5};
constexpr DeformWeights kEven = {0.4, 0.3, 0.3};
constexpr std::array<DeformWeights, 5> kFabrics = {kCanvas, kCotton, kSilk, kLinen, kEven};

TriangleMesh sheet(int cells) {
  return triangulated_sheet(Triangulation::alternating, cells, cells, kSide / cells);
}

/// Corners and middle of a sheet, each with what is within `radius` of it [m].
struct HeldPatch {
  std::vector<VertexId> vertices;
  std::vector<char> is_middle;

  HeldPatch(const TriangleMesh& mesh, double radius) {
    const Positions& x = mesh.rest_positions;
    const Vec3 low = x.rowwise().minCoeff();
    const Vec3 size = x.rowwise().maxCoeff() - low;
    for (const auto& [s, t] : {std::pair(0.0, 0.0), {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}, {0.5, 0.5}})
      for (Eigen::Index v = 0; v < x.cols(); ++v)
        if ((x.col(v) - low - size.cwiseProduct(Vec3(s, t, 0))).norm() <= radius) {
          vertices.push_back(VertexId(v));
          is_middle.push_back(s == 0.5);
        }
  }

  /// Places of the held vertices with the middle ones moved [m].
  Positions places(const TriangleMesh& mesh, const Vec3& move) const {
    Positions result(3, static_cast<Eigen::Index>(vertices.size()));
    for (std::size_t k = 0; k < vertices.size(); ++k)
      result.col(static_cast<Eigen::Index>(k)) =
          mesh.rest_positions.col(vertices[k]) + (is_middle[k] != 0 ? move : Vec3(0, 0, 0));
    return result;
  }
};

DeformSolver pulled(const TriangleMesh& mesh, EnergyForm form, const DeformWeights& weights,
                    const Vec3& move) {
  const HeldPatch hold(mesh, 0.05 * kSide);
  DeformSolver solver(mesh, form, weights);
  solver.hold(hold.vertices);
  solver.move_held(hold.places(mesh, move));
  return solver;
}

/// Least energy by Barzilai & Borwein's gradient steps with the best value kept, nothing in common
/// with the solver but energy and gradient.
double independent_minimum(const DeformSolver& start) {
  const DeformEnergy& energy = start.model();
  const auto free_gradient = [&](const Positions& x) {
    Positions gradient = energy.gradient(start.weights(), x);
    for (const VertexId v : start.held()) gradient.col(v).setZero();
    return gradient;
  };
  Positions x = start.positions();
  Positions gradient = free_gradient(x);
  double length = 1e-6;
  double best = start.energy();
  double reference = best;  // no step may lead higher than the worst of some before it
  std::deque<double> recent = {best};
  for (int step = 0; step < 200'000 && gradient.norm() > 1e-9 * best / kSide; ++step) {
    Positions next = x - length * gradient;
    double value = energy.terms(next).weighted(start.weights());
    while (value > reference) {
      length /= 4;
      next = x - length * gradient;
      value = energy.terms(next).weighted(start.weights());
    }
    const Positions next_gradient = free_gradient(next);
    const Positions s = next - x;
    const double product = s.cwiseProduct(next_gradient - gradient).sum();
    length = product > 0 ? s.squaredNorm() / product : 2 * length;
    x = next;
    gradient = next_gradient;
    best = std::min(best, value);
    recent.push_back(value);
    if (recent.size() > 10) recent.pop_front();
    reference = *std::max_element(recent.begin(), recent.end());
  }
  return best;
}

}  // namespace

TEST_CASE("deform_solver: where it has settled an independent optimiser has nothing to gain",
          "[deform][long]") {
  // Two corners of a coarse square that come together, where bending dominates and edges fold: the
  // last of the way goes in short steps.
  const auto [triangulation, fabric] = GENERATE(std::pair(Triangulation::one_way, "leather"),
                                                std::pair(Triangulation::alternating, "spandex"),
                                                std::pair(Triangulation::alternating, "gabardine"));
  CAPTURE(fabric);
  const TriangleMesh mesh = triangulated_sheet(triangulation, 8, 8, 0.125);
  const DeformWeights weights = recomputed_weights(fabric_library().find(fabric).normalised);
  DeformSolver solver(mesh, EnergyForm::published, weights);
  solver.hold({VertexId(0), VertexId(8)});
  Positions places(3, 2);
  places << mesh.rest_positions.col(0) + Vec3(0.175, 0, 0),
      mesh.rest_positions.col(8) - Vec3(0.175, 0, 0);
  solver.move_held(places);
  REQUIRE(solver.settle().ok());
  CHECK(solver.energy() / independent_minimum(solver) - 1 <
        1.5e-4);  // it still stops short at kinks
}

TEST_CASE("deform_solver: the least energy is that of an independent optimiser", "[deform][long]") {
  const EnergyForm form = GENERATE(EnergyForm::consistent, EnergyForm::published);
  const DeformWeights weights = GENERATE(from_range(kFabrics));
  CAPTURE(form, weights.recovery);
  const TriangleMesh mesh = sheet(8);
  DeformSolver solver = pulled(mesh, form, weights, Vec3(0.02, 0.01, 0.1));
  const double expected = independent_minimum(solver);
  CHECK(solver.solve(kFarAhead).ok());
  CHECK(solver.energy() == Approx(expected).epsilon(1e-6));
}

TEST_CASE("deform_solver: the energy falls in every step", "[deform]") {
  const EnergyForm form = GENERATE(EnergyForm::consistent, EnergyForm::published);
  const DeformWeights weights = GENERATE(from_range(kFabrics));
  const Vec3 move = GENERATE(Vec3(0, 0, 0.1), Vec3(0.1, 0, 0), Vec3(-0.3, 0.2, 0.6));
  DeformSolver solver = pulled(sheet(12), form, weights, move);
  double before = solver.energy();
  solver.solve();
  REQUIRE(!solver.steps().empty());
  for (const DeformStep& step : solver.steps()) {
    CHECK(step.energy < before);
    CHECK(step.energy == Approx(step.terms.weighted(weights)));
    before = step.energy;
  }
  CHECK(solver.energy() == before);
}

TEST_CASE("deform_solver: what is held is where it was moved, to the bit", "[deform]") {
  const TriangleMesh mesh = sheet(10);
  const HeldPatch hold(mesh, 0.05 * kSide);
  const Positions places = hold.places(mesh, Vec3(0.03, 0, 0.08));
  DeformSolver solver(mesh, EnergyForm::consistent, kCotton);
  solver.hold(hold.vertices);
  solver.move_held(places);
  solver.solve();
  for (std::size_t k = 0; k < hold.vertices.size(); ++k)
    CHECK(solver.positions().col(hold.vertices[k]) == places.col(static_cast<Eigen::Index>(k)));
}

TEST_CASE("deform_solver: nothing moved stays at rest", "[deform]") {
  const TriangleMesh mesh = sheet(6);
  DeformSolver solver = pulled(mesh, EnergyForm::consistent, kCanvas, Vec3(0, 0, 0));
  CHECK(solver.solve().ok());
  CHECK(solver.converged());
  CHECK((solver.positions() - mesh.rest_positions).norm() < 1e-12);
}

TEST_CASE("deform_solver: a sheet folded onto itself at rest stays finite", "[deform]") {
  TriangleMesh mesh = sheet(6);
  for (auto x : mesh.rest_positions.colwise())
    if (x.x() > kSide / 2 + 1e-9) x.x() = kSide - x.x();  // normals cancel along the fold
  const EnergyForm form = GENERATE(EnergyForm::consistent, EnergyForm::published);
  DeformSolver solver(mesh, form, kEven);
  solver.hold({VertexId(0)});
  const Positions place = mesh.rest_positions.col(0);
  solver.restart(place);
  solver.solve();
  CHECK(solver.positions().allFinite());
  CHECK(std::isfinite(solver.energy()));
}

TEST_CASE("deform_solver: with recovery alone only what is held moves", "[deform]") {
  const TriangleMesh mesh = sheet(6);
  DeformSolver solver = pulled(mesh, EnergyForm::consistent, {1, 0, 0}, Vec3(0, 0, 0.1));
  CHECK(solver.solve().ok());
  CHECK(solver.energy() == Approx(0).margin(1e-20));
}

TEST_CASE("deform_solver: a kept factor serves while the hand moves on", "[deform]") {
  const TriangleMesh mesh = sheet(16);
  const HeldPatch hold(mesh, 0.05 * kSide);
  DeformSolver solver = pulled(mesh, EnergyForm::consistent, kCanvas, Vec3(0, 0, 0.08));
  solver.solve();
  const int n_before = solver.n_linearisations();
  solver.follow(hold.places(mesh, Vec3(0, 0, 0.085)));
  CHECK(solver.n_linearisations() == n_before);
  DeformSolver anew = pulled(mesh, EnergyForm::consistent, kCanvas, Vec3(0, 0, 0.085));
  anew.solve();
  CHECK(solver.energy() < 1.001 * anew.energy());
}

TEST_CASE("deform_solver: equal weights change nothing", "[deform]") {
  DeformSolver solver = pulled(sheet(8), EnergyForm::consistent, kCanvas, Vec3(0, 0, 0.08));
  REQUIRE(solver.solve().ok());
  const Positions shape = solver.positions();
  const std::size_t n_steps = solver.steps().size();
  solver.set_weights(kCanvas);
  CHECK(solver.steps().size() == n_steps);
  CHECK(solver.converged());
  CHECK(solver.positions() == shape);
  solver.set_weights({kCanvas.recovery, kCanvas.stretch, 2 * kCanvas.bending});
  CHECK(solver.steps().empty());
  CHECK_FALSE(solver.converged());
}

TEST_CASE("deform_solver: pulled far out and back it ends no higher than from rest", "[deform]") {
  const DeformWeights weights = GENERATE(from_range(kFabrics));
  CAPTURE(weights.recovery);
  const TriangleMesh mesh = sheet(12);
  const HeldPatch hold(mesh, 0.05 * kSide);
  const Positions end = hold.places(mesh, Vec3(0, 0, 0.05));
  DeformSolver solver(mesh, EnergyForm::consistent, weights);
  solver.hold(hold.vertices);
  for (const double reach : {0.1, 1.0, 10.0, 100.0, 10.0, 1.0}) {
    solver.move_held(hold.places(mesh, reach * kSide * Vec3(0.6, 0, 0.8)));
    solver.step();
  }
  solver.move_held(end);
  solver.settle();
  CHECK(solver.positions().allFinite());
  DeformSolver straight(mesh, EnergyForm::consistent, weights);
  straight.hold(hold.vertices);
  for (const double share : {0.25, 0.5, 0.75, 1.0}) {
    straight.move_held(hold.places(mesh, Vec3(0, 0, share * 0.05)));
    straight.solve(kFarAhead);
  }
  CHECK(solver.energy() <= straight.energy() * (1 + 1e-6));
}

TEST_CASE("deform_solver: what is held as one costs no more than cloth turned along with it",
          "[deform]") {
  const EnergyForm form = GENERATE(EnergyForm::consistent, EnergyForm::published);
  const DeformWeights weights = GENERATE(from_range(kFabrics), DeformWeights{1e-6, 0.98, 0.02});
  const double degrees = GENERATE(60.0, 120.0, 170.0);
  const Vec3 axis = GENERATE(Vec3(0, 0, 1), Vec3(0, 1, 0));
  CAPTURE(form, weights.recovery, degrees, axis);
  const TriangleMesh mesh = sheet(8);
  const Mat3 turn = Eigen::AngleAxisd(degrees * kPi / 180, axis).toRotationMatrix();
  const Vec3 middle(kSide / 2, kSide / 2, 0);
  const Positions turned = (turn * (mesh.rest_positions.colwise() - middle)).colwise() + middle;
  std::vector<VertexId> corners;
  Positions places(3, 3);
  for (const int v : {0, 8, 72}) {
    places.col(static_cast<Eigen::Index>(corners.size())) = turned.col(v);
    corners.emplace_back(v);
  }
  DeformSolver solver(mesh, form, weights);
  solver.hold(corners);
  solver.restart(places);
  solver.solve();
  constexpr double kRounding = 1e-4;  // the last step's length is a matter of 1e-6
  CHECK(solver.energy() <= (1 + kRounding) * solver.model().terms(turned).weighted(weights));
}

TEST_CASE("deform_solver: pushed together in its plane cloth buckles", "[deform]") {
  const TriangleMesh mesh = sheet(20);
  std::vector<VertexId> ends;
  Positions places(3, 42);
  for (Eigen::Index v = 0; v < mesh.rest_positions.cols(); ++v) {
    const Vec3 x = mesh.rest_positions.col(v);
    const bool is_left = x.x() < 1e-9;
    if (!is_left && x.x() < kSide - 1e-9) continue;
    places.col(static_cast<Eigen::Index>(ends.size())) =
        x + Vec3(is_left ? 0.05 * kSide : -0.05 * kSide, 0, 0);
    ends.push_back(VertexId(v));
  }
  DeformSolver solver(mesh, EnergyForm::consistent, {0.001, 0.9, 0.01});
  solver.hold(ends);
  solver.move_held(places);
  solver.solve(kFarAhead);
  const double flat_energy = solver.energy();
  solver.settle();
  CHECK(solver.energy() < 0.5 * flat_energy);
  CHECK(solver.positions().row(2).cwiseAbs().maxCoeff() > 0.05 * kSide);
}

TEST_CASE("deform_solver: held at one point alone it stays finite", "[deform]") {
  DeformSolver solver(sheet(4), EnergyForm::consistent, {0, 0.5, 0.5});
  solver.hold({VertexId(0)});
  Positions place(3, 1);
  place << 0, 0, 0.1;
  solver.move_held(place);
  solver.solve();
  CHECK(solver.positions().allFinite());
}

TEST_CASE("deform_solver: one fabric has one shape on any mesh", "[deform]") {
  const DeformWeights weights = GENERATE(from_range(kFabrics));
  CAPTURE(weights.recovery);
  std::vector<double> heights;  // heights at the middle of one side's quarter, off all that is held
  for (const Triangulation pattern : {Triangulation::one_way, Triangulation::alternating}) {
    const TriangleMesh mesh = triangulated_sheet(pattern, 20, 20, kSide / 20);
    DeformSolver solver = pulled(mesh, EnergyForm::consistent, weights, Vec3(0, 0, 0.25 * kSide));
    solver.solve(kFarAhead);
    for (Eigen::Index v = 0; v < mesh.rest_positions.cols(); ++v)
      if ((mesh.rest_positions.col(v) - Vec3(0.25, 0.5, 0) * kSide).norm() < 1e-9)
        heights.push_back(solver.positions()(2, v));
  }
  REQUIRE(heights.size() == 2);
  CHECK(std::abs(heights[0] - heights[1]) < 0.01 * kSide);
}

TEST_CASE("deform_solver: cloth far from the origin has the same shape there", "[deform]") {
  const EnergyForm form = GENERATE(EnergyForm::consistent, EnergyForm::published);
  const DeformWeights weights = GENERATE(kCanvas, kLinen, kPlaceless);
  const double far = GENERATE(1e6, 1e8);  // [m]
  CAPTURE(form, weights.recovery, far);
  const Vec3 pull(0, 0.03, 0.1);
  TriangleMesh mesh = sheet(12);
  DeformSolver here = pulled(mesh, form, weights, pull);
  CHECK(here.solve(kFarAhead).ok());
  const HeldPatch hold(mesh, 0.05 * kSide);
  mesh.rest_positions.colwise() += Vec3(far, far / 3, -far);
  DeformSolver there(mesh, form, weights);
  there.hold(hold.vertices);
  there.move_held(hold.places(mesh, pull));
  CHECK(there.solve(kFarAhead).ok());
  CHECK(there.energy() == Approx(here.energy()).epsilon(1e-5));  // 1e-8 m are the last digits
}

TEST_CASE("deform_solver: once converged it has hardly anything left to gain", "[deform]") {
  const double pull = GENERATE(0.0015, 0.003);  // [m]; of many short steps
  const double unit = GENERATE(1e-9, 1.0);
  CAPTURE(pull, unit);
  const DeformWeights weights = {1e-5 * unit, 0.32 * unit, 1.4e-4 * unit};
  DeformSolver solver =
      pulled(sheet(8), EnergyForm::consistent, weights, Vec3(0, 0.3 * pull, pull));
  solver.solve(kFarAhead);
  REQUIRE(solver.converged());
  const double energy = solver.energy();
  for (int anew = 0; anew < 10; ++anew) {
    solver.take_back({solver.positions(), {}, false});
    solver.solve(kFarAhead);
  }
  CHECK(solver.energy() == Approx(energy).epsilon(1e-4));
}

TEST_CASE("deform_solver: weights in another unit have the same shape", "[deform]") {
  const EnergyForm form = GENERATE(EnergyForm::consistent, EnergyForm::published);
  const DeformWeights weights = GENERATE(from_range(kFabrics));
  const double unit = GENERATE(1e-9, 1e9);
  CAPTURE(form, weights.recovery, unit);
  const auto solved = [&](const DeformWeights& chosen) {
    DeformSolver solver = pulled(sheet(8), form, chosen, Vec3(0.02, 0.01, 0.1));
    CHECK(solver.solve(kFarAhead).ok());
    return solver;
  };
  const DeformSolver expected = solved(weights);
  const DeformSolver found =
      solved({unit * weights.recovery, unit * weights.stretch, unit * weights.bending});
  CHECK(found.energy() == Approx(unit * expected.energy()).epsilon(1e-6));
  CHECK((found.positions() - expected.positions()).colwise().norm().maxCoeff() < 1e-3 * kSide);
}

TEST_CASE("deform_solver: cloth that lies askew has the same shape, askew", "[deform]") {
  const EnergyForm form = GENERATE(EnergyForm::consistent, EnergyForm::published);
  const DeformWeights weights = GENERATE(kCanvas, kSilk, kLinen, kEven);
  CAPTURE(form, weights.recovery);
  const Mat3 turn = Eigen::AngleAxisd(kPi / 4, Vec3(0.2, 0.3, 1).normalized()).toRotationMatrix();
  const Vec3 pull(0.01, 0, 0.06);
  const TriangleMesh level = sheet(12);
  TriangleMesh askew = level;
  askew.rest_positions = turn * level.rest_positions;
  for (Vec3& warp : askew.warp_directions) warp = turn * warp;
  const HeldPatch hold(level, 0.05 * kSide);
  const auto shape = [&](const TriangleMesh& mesh, const Positions& places) {
    DeformSolver solver(mesh, form, weights);
    solver.hold(hold.vertices);
    solver.restart(places);
    solver.solve(kFarAhead);
    return solver.positions();
  };
  const Positions places = hold.places(level, pull);
  constexpr double kLastSteps = 1e-4;  // share of the side: each may leave off a millionth early
  CHECK((shape(askew, turn * places) - turn * shape(level, places)).colwise().norm().maxCoeff() <
        kLastSteps * kSide);
}

TEST_CASE("deform_solver: the same calls give the same bits", "[deform]") {
  const auto run = [] {
    DeformSolver solver = pulled(sheet(10), EnergyForm::consistent, kCotton, Vec3(0, 0, 0.1));
    solver.settle();
    return solver.positions();
  };
  CHECK(run() == run());
}

}  // namespace pleat
