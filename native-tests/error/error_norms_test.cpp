#include "core/error/error_norms.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "native-tests/support/meshes.h"

using namespace pleat;

namespace {

QuadMesh refined_sheet(int cells, int level) {
  QuadMesh mesh = square_sheet(cells);
  mesh.refine_uniformly(level);
  return mesh;
}

}  // namespace

TEST_CASE("error_norms: a translated copy is wrong by the translation", "[error]") {
  const QuadMesh mesh = refined_sheet(GENERATE(1, 3), GENERATE(0, 2));
  const Vec3 offset(0.3, -0.4, 1.2);
  const Positions moved = mesh.rest_positions().colwise() + offset;
  CHECK(position_error(moved, mesh.rest_positions(), mesh.vertex_areas()) ==
        Approx(offset.norm()).epsilon(1e-14));
}

TEST_CASE("error_norms: a refined copy is not wrong, whichever side is finer", "[error]") {
  const QuadMesh coarse = refined_sheet(3, 0);
  const QuadMesh fine = refined_sheet(3, 2);
  CHECK(position_error(coarse.rest_positions(), fine.rest_positions(), coarse.vertex_areas()) == 0);
  CHECK(position_error(fine.rest_positions(), coarse.rest_positions(), coarse.vertex_areas()) == 0);
}

// A displacement s u of a sheet of unit height has the RMS s/sqrt(3). Weights of a quarter of each
// face are the trapezoid rule: its error falls with the square of the spacing.
TEST_CASE("error_norms: the error of a sheared copy converges to its integral", "[error]") {
  const double exact = 1 / std::sqrt(3.0);
  std::vector<double> differences;
  for (const int level : {1, 2, 3}) {
    const QuadMesh mesh = refined_sheet(2, level);
    Positions moved = mesh.rest_positions();
    moved.row(2) += mesh.rest_coordinates().row(0);
    differences.push_back(position_error(moved, mesh.rest_positions(), mesh.vertex_areas()) -
                          exact);
  }
  CHECK(differences[0] / differences[1] == Approx(4).epsilon(0.05));
  CHECK(differences[1] / differences[2] == Approx(4).epsilon(0.05));
}

TEST_CASE("error_norms: areas must fit the shared vertices", "[error]") {
  const QuadMesh mesh = square_sheet(2);
  const Eigen::VectorXd too_few = Eigen::VectorXd::Ones(3);
  CHECK_THROWS_AS(position_error(mesh.rest_positions(), mesh.rest_positions(), too_few),
                  ContractError);
}
