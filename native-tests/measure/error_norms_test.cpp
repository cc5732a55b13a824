#include "core/measure/error_norms.h"

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

TEST_CASE("error_norms: a translated copy is wrong by the translation", "[measure]") {
  const QuadMesh mesh = refined_sheet(GENERATE(1, 3), GENERATE(0, 2));
  const Vec3 offset(0.3, -0.4, 1.2);
  const Positions moved = mesh.rest_positions().colwise() + offset;
  CHECK(position_error(moved, mesh.rest_positions(), mesh.vertex_areas()) ==
        Approx(offset.norm()).epsilon(1e-14));
}

TEST_CASE("error_norms: a refined copy is not wrong, whichever side is finer", "[measure]") {
  const QuadMesh coarse = refined_sheet(3, 0);
  const QuadMesh fine = refined_sheet(3, 2);
  CHECK(position_error(coarse.rest_positions(), fine.rest_positions(), coarse.vertex_areas()) == 0);
  CHECK(position_error(fine.rest_positions(), coarse.rest_positions(), coarse.vertex_areas()) == 0);
}

// A displacement s u of a sheet of unit height has the RMS s/sqrt(3). Weights of a quarter of each
// face are the trapezoid rule: its error falls with the square of the spacing.
TEST_CASE("error_norms: the error of a sheared copy converges to its integral", "[measure]") {
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

TEST_CASE("error_norms: areas must fit the shared vertices", "[measure]") {
  const QuadMesh mesh = square_sheet(2);
  const Eigen::VectorXd too_few = Eigen::VectorXd::Ones(3);
  CHECK_THROWS_AS(position_error(mesh.rest_positions(), mesh.rest_positions(), too_few),
                  ContractError);
}

TEST_CASE("error_norms: a sheet's rest diagonal does not depend on how it lies", "[measure]") {
  Scene scene;
  auto& shape = std::get<SheetShape>(scene.cloth);
  shape.width = 0.3;
  shape.height = 0.4;
  shape.warp_direction = Vec3(0, -1, 1).normalized();
  CHECK(rest_diagonal(scene) == Approx(0.5).epsilon(1e-15));
}

TEST_CASE("error_norms: uniform extension is the strain of every gauge edge", "[measure]") {
  const double strain = GENERATE(0.02, -0.03, 0.0);
  const QuadMesh mesh = refined_sheet(3, 1);
  const std::vector<GaugeEdge> gauge =
      GENERATE(true, false) ? gauge_edges(mesh) : gauge_edges(mesh.triangle_mesh());
  const Positions stretched = (1 + strain) * mesh.rest_positions();
  const Stretch found = stretch(gauge, stretched);
  const double expected = std::abs(strain);
  CHECK(found.rms == Approx(expected).epsilon(1e-10).margin(1e-14));
  CHECK(found.largest == Approx(expected).epsilon(1e-10).margin(1e-14));
  StrainMap map(gauge, mesh.n_vertices());
  for (const float value : map.update(stretched))
    CHECK(value == Approx(strain).epsilon(1e-6).margin(1e-7));
}

// Half of a square sheet's gauge edges run along warp, so the RMS is the strain over sqrt(2).
TEST_CASE("error_norms: a sheet is gauged along its threads alone", "[measure]") {
  const QuadMesh mesh = square_sheet(4);
  Positions along_warp = mesh.rest_positions();
  along_warp.row(1) *= 1.01;  // warp runs down
  const Stretch found = stretch(gauge_edges(mesh), along_warp);
  CHECK(found.largest == Approx(0.01).epsilon(1e-10));
  CHECK(found.rms == Approx(0.01 / std::sqrt(2.0)).epsilon(1e-10));
}

TEST_CASE("error_norms: cloth without a gauge is not stretched", "[measure]") {
  const Positions positions = Positions::Random(3, 2);
  CHECK(stretch({}, positions).largest == 0);
  CHECK(stretch({}, positions).rms == 0);
}
