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

TEST_CASE("error_norms: a median is in the middle of any order", "[error]") {
  CHECK(median({3, 1, 2}) == 2);
  CHECK(median({4, 1, 3, 2}) == 2.5);
  CHECK(std::isnan(median({})));
}

namespace {

Positions two_at(double distance) {
  Positions positions(3, 2);
  positions << 1 + distance, 4, 2, 5 - 2 * distance, 3, 6;
  return positions;
}

const Eigen::Vector2d kTwoAreas(1, 3);

}  // namespace

TEST_CASE("error_norms: the limit of three meshes is found at any rate", "[error]") {
  const double rate = GENERATE(0.5, 1.0, 2.0);
  CAPTURE(rate);
  std::array<Positions, 3> meshes;
  for (std::size_t k = 0; k < 3; ++k)
    meshes[k] = two_at(0.1 * std::exp2(-rate * static_cast<double>(k)));
  meshes[2].conservativeResize(3, 3);  // a finer mesh has more vertices
  meshes[2].col(2).setConstant(7);
  const MeshLimit limit = observed_limit(meshes, kTwoAreas);
  CHECK(limit.rate == Approx(rate).epsilon(1e-10));
  CHECK((limit.positions - two_at(0)).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(limit.distances[0] / limit.distances[1] == Approx(std::exp2(rate)).epsilon(1e-10));
}

TEST_CASE("error_norms: meshes that do not come nearer have no limit", "[error]") {
  const MeshLimit limit = observed_limit({two_at(0), two_at(0.1), two_at(0.3)}, kTwoAreas);
  CHECK(limit.rate == Approx(-1).epsilon(1e-10));
  CHECK(std::isnan(limit.positions(0, 0)));
}
