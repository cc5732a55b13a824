#include "core/deform/deform_settling.h"

#include <catch2/catch.hpp>

#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

constexpr double kClothSide = 0.4;  // [m]

/// Pushed together in its plane and solved there: flat, where buckled is lower.
DeformSolver pushed_flat() {
  const TriangleMesh mesh = triangulated_sheet(Triangulation::alternating, 12, 12, kClothSide / 12);
  std::vector<VertexId> ends;
  std::vector<Vec3> places;
  for (Eigen::Index v = 0; v < mesh.rest_positions.cols(); ++v) {
    const Vec3 x = mesh.rest_positions.col(v);
    if (x.x() > 1e-9 && x.x() < kClothSide - 1e-9) continue;
    ends.emplace_back(v);
    places.push_back(x +
                     Vec3(x.x() < kClothSide / 2 ? 0.05 * kClothSide : -0.05 * kClothSide, 0, 0));
  }
  Positions columns(3, static_cast<Eigen::Index>(places.size()));
  for (std::size_t k = 0; k < places.size(); ++k)
    columns.col(static_cast<Eigen::Index>(k)) = places[k];
  DeformSolver solver(mesh, EnergyForm::consistent, {0.001, 0.9, 0.01});
  solver.hold(ends);
  solver.move_held(columns);
  solver.solve(1000);
  return solver;
}

}  // namespace

TEST_CASE("deform_settling: step by step it comes to the bit where settling comes", "[deform]") {
  DeformSolver at_once = pushed_flat();
  const SolveReport whole = at_once.settle();
  DeformSolver stepped = pushed_flat();
  DeformSettling settling(stepped);
  bool was_between = false;
  bool was_on_trial = false;
  while (!settling.done()) {
    if (settling.is_between()) {
      was_between = true;
      CHECK(stepped.converged());  // the end of the first way, to be shown
    }
    settling.step();
    was_on_trial = was_on_trial || settling.is_on_trial();
  }
  CHECK(was_between);
  CHECK(was_on_trial);
  CHECK(stepped.positions() == at_once.positions());
  CHECK(settling.report().status == whole.status);
  CHECK(settling.report().iterations == whole.iterations);
}

TEST_CASE("deform_settling: from here alone it stays in the shape's own valley", "[deform]") {
  DeformSolver solver = pushed_flat();
  const double flat_energy = solver.energy();
  DeformSettling settling(solver, DeformSettling::Ways::from_here);
  while (!settling.done()) settling.step();
  CHECK(solver.energy() <= flat_energy);
  CHECK(solver.energy() > 0.9 * flat_energy);
}

TEST_CASE("deform_settling: a trial given up keeps the shape of lower energy", "[deform]") {
  DeformSolver solver = pushed_flat();
  const Positions flat = solver.positions();
  const double flat_energy = solver.energy();
  DeformSettling settling(solver);
  settling.end_trial();
  CHECK_FALSE(settling.done());  // none had begun
  while (!settling.is_on_trial()) settling.step();
  const bool was_lower_at_once = solver.energy() < flat_energy;
  settling.end_trial();
  CHECK(settling.done());
  CHECK(solver.energy() <= flat_energy);
  CHECK((solver.positions() == flat) == !was_lower_at_once);
}

}  // namespace pleat
