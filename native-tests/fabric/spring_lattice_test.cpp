#include "core/fabric/spring_lattice.h"

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "core/base/check.h"
#include "core/model/elasticity.h"
#include "core/model/system_matrix.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr double kStrain = 1e-4;  // small: the energy of Hooke springs is quadratic to its square

/// In-plane strains of a flat sheet: along warp, along weft, and the engineering shear.
struct Strain {
  double warp = 0, weft = 0, shear = 0;
};

/// x = (u, v) strained symmetrically.
Positions strained(const QuadMesh& mesh, const Strain& strain) {
  const RestCoordinates& uv = mesh.rest_coordinates();
  Positions x = Positions::Zero(3, mesh.n_vertices());
  x.row(0) = (1 + strain.warp) * uv.row(0) + strain.shear / 2 * uv.row(1);
  x.row(1) = (1 + strain.weft) * uv.row(1) + strain.shear / 2 * uv.row(0);
  return x;
}

double sheet_area(const QuadMesh& mesh) { return mesh.vertex_areas().sum(); }

/// Energy per area over strain^2 / 2, the odd part of its expansion left out [N/m].
double modulus(const QuadMesh& mesh, const ClothModel& model, const Strain& unit) {
  const auto energy = [&](double e) {
    return elastic_energy(model, strained(mesh, {e * unit.warp, e * unit.weft, e * unit.shear}));
  };
  return (energy(kStrain) + energy(-kStrain)) / (kStrain * kStrain * sheet_area(mesh));
}

/// Pull of the sheet on its edge u = 0, per width [N/m]: along warp and along weft.
Eigen::Vector2d edge_pull(const QuadMesh& mesh, const ClothModel& model, const Strain& strain) {
  Positions forces = Positions::Zero(3, mesh.n_vertices());
  add_elastic_forces(model, strained(mesh, strain), forces);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i < mesh.n_vertices(); ++i)
    if (mesh.rest_coordinates()(0, i) == 0) sum += forces.col(i).head<2>();
  return sum / mesh.rest_coordinates().row(1).maxCoeff();
}

double bending_energy(const ClothModel& model, const Positions& x) {
  ClothModel bends_alone = model;
  bends_alone.springs.clear();
  return elastic_energy(bends_alone, x);
}

}  // namespace

TEST_CASE(
    "spring_lattice: stretch and shear moduli are the fabric's at every resolution and aspect",
    "[fabric]") {
  const int cells = GENERATE(8, 16, 32, 64);
  const double aspect = GENERATE(0.7, 1.0, 1.4);
  CAPTURE(cells, aspect);
  const QuadMesh mesh = sheet_with_aspect(cells, cells, aspect);
  const FabricConstants fabric = library_fabric("fine cotton");
  const ClothModel model = sheet_model(mesh, fabric);
  constexpr double kTolerance = 1e-3;  // promised; what is left is strain^2
  CHECK(modulus(mesh, model, {1, 0, 0}) == Approx(fabric.stretch_warp).epsilon(kTolerance));
  CHECK(modulus(mesh, model, {0, 1, 0}) == Approx(fabric.stretch_weft).epsilon(kTolerance));
  CHECK(modulus(mesh, model, {0, 0, 1}) == Approx(fabric.shear).epsilon(kTolerance));
  // 1/2 (K_u + 2 C12 + K_v) e^2 for equal stretch both ways.
  CHECK(modulus(mesh, model, {1, 1, 0}) - fabric.stretch_warp - fabric.stretch_weft ==
        Approx(2 * fabric.shear).epsilon(2 * kTolerance));
}

TEST_CASE("spring_lattice: all fabrics have their moduli in every cell up to aspect 1.4",
          "[fabric]") {
  const double aspect = GENERATE(0.7, 1.4);
  for (const FabricConstants& fabric : library_fabrics()) {
    CAPTURE(fabric.name, aspect);
    const QuadMesh mesh = sheet_with_aspect(8, 8, aspect);
    const ClothModel model = sheet_model(mesh, fabric);
    CHECK(modulus(mesh, model, {1, 0, 0}) == Approx(fabric.stretch_warp).epsilon(1e-3));
    CHECK(modulus(mesh, model, {0, 1, 0}) == Approx(fabric.stretch_weft).epsilon(1e-3));
    CHECK(modulus(mesh, model, {0, 0, 1}) == Approx(fabric.shear).epsilon(1e-3));
  }
}

TEST_CASE("spring_lattice: resultants at an edge are those of the moduli", "[fabric]") {
  const int cells = GENERATE(8, 32);
  const double aspect = GENERATE(0.7, 1.4);
  CAPTURE(cells, aspect);
  const QuadMesh mesh = sheet_with_aspect(cells, cells, aspect);
  const FabricConstants fabric = library_fabric("canvas");
  const ClothModel model = sheet_model(mesh, fabric);
  constexpr double kTolerance = 1e-3;  // error of first order in the strain here
  const Strain stretch{kStrain, 0.5 * kStrain, 0};
  CHECK(
      edge_pull(mesh, model, stretch).x() ==
      Approx(fabric.stretch_warp * stretch.warp + fabric.shear * stretch.weft).epsilon(kTolerance));
  CHECK(edge_pull(mesh, model, {0, 0, kStrain}).y() ==
        Approx(fabric.shear * kStrain).epsilon(kTolerance));
}

TEST_CASE("spring_lattice: a strip pulled at both ends shows K_u - G^2/K_v", "[fabric]") {
  const double aspect = GENERATE(0.7, 1.0, 1.4);
  const std::string name = GENERATE("leather", "spandex", "canvas");
  CAPTURE(aspect, name);
  const QuadMesh mesh = sheet_with_aspect(6, 5, aspect);
  const FabricConstants fabric = library_fabric(name);
  const ClothModel model = sheet_model(mesh, fabric);
  const Eigen::MatrixXd K =
      dense(stiffness_matrix(model, strained(mesh, {}), ElementHessian::exact));
  // A line load of 1 N/m along both ends; corners carry half a cell.
  const RestCoordinates& uv = mesh.rest_coordinates();
  const double height = uv.row(0).maxCoeff();
  const double width = uv.row(1).maxCoeff();
  Eigen::VectorXd load = Eigen::VectorXd::Zero(K.rows());
  for (int i = 0; i < mesh.n_vertices(); ++i) {
    if (uv(0, i) != 0 && uv(0, i) != height) continue;
    const bool corner = uv(1, i) == 0 || uv(1, i) == width;
    load[3 * i] = (uv(0, i) == 0 ? -1 : 1) * width / 5 * (corner ? 0.5 : 1);
  }
  // The least-squares solution leaves rigid motions and the flat sheet's free normals alone.
  const Eigen::VectorXd moved = K.completeOrthogonalDecomposition().solve(load);
  const double elongation = moved[3 * (mesh.n_vertices() - 1)] - moved[0];
  const double stiffness = fabric.stretch_warp - fabric.shear * fabric.shear / fabric.stretch_weft;
  CHECK(height / elongation == Approx(stiffness).epsilon(1e-9));
}

TEST_CASE("spring_lattice: cells too long for a fabric's shear are refused by its name",
          "[fabric]") {
  // Leather carries cells up to sqrt(K_v/G) = 1.63 along weft, spandex up to sqrt(96/30) = 1.79.
  const auto [name, carried, refused] = GENERATE(table<std::string, double, double>(
      {{"leather", 1 / 1.6, 1 / 1.65}, {"spandex", 1 / 1.75, 1 / 1.8}}));
  CAPTURE(name);
  const FabricConstants fabric = library_fabric(name);
  CHECK_NOTHROW(spring_lattice(sheet_with_aspect(4, 4, carried), fabric));
  try {
    spring_lattice(sheet_with_aspect(4, 4, refused), fabric);
    FAIL("nothing was thrown");
  } catch (const InputError& error) {
    CHECK(error.sentence().find(name) != std::string::npos);
    CHECK(error.where() == "/fabric");
  }
}

TEST_CASE("spring_lattice: a sheet rolled to a cylinder stores half B kappa^2 per area",
          "[fabric]") {
  const int cells = GENERATE(8, 16, 32, 64);
  const double turn = GENERATE(0.05, 0.2, 0.4);  // [rad] per edge
  CAPTURE(cells, turn);
  FabricConstants fabric = library_fabric("wool");
  const QuadMesh mesh = sheet_with_aspect(cells, cells, 1.2);
  const ClothModel model = sheet_model(mesh, fabric);
  // The circle through the vertices: edges are its chords, L = 2 R sin(turn/2).
  const double warp_edge = 1.2 / cells;
  const double weft_edge = 1.0 / cells;
  const double inner_area = 1.2 * (cells - 1) / cells;  // the border rows hold no element
  const double warp_curvature = 2 * std::sin(turn / 2) / warp_edge;
  const double weft_curvature = 2 * std::sin(turn / 2) / weft_edge;
  constexpr double kTolerance = 0.02;  // promised
  CHECK(bending_energy(model, rolled_along_warp(mesh, cells, turn)) ==
        Approx(0.5 * fabric.bend_warp * warp_curvature * warp_curvature * inner_area)
            .epsilon(kTolerance));
  CHECK(bending_energy(model, rolled_along_weft(mesh, cells, turn)) ==
        Approx(0.5 * fabric.bend_weft * weft_curvature * weft_curvature * inner_area)
            .epsilon(kTolerance));
}

TEST_CASE("spring_lattice: rolling keeps structural springs at rest", "[fabric]") {
  const QuadMesh mesh = square_sheet(8);
  const Positions x = rolled_along_warp(mesh, 8, 0.4);
  for (const Spring& spring : spring_lattice(mesh, library_fabric("wool")).springs) {
    if (spring.kind == SpringKind::shear) continue;
    CHECK((x.col(spring.a) - x.col(spring.b)).norm() == Approx(spring.rest_length).epsilon(1e-12));
  }
}

TEST_CASE("spring_lattice: a sheet of 16 x 12 vertices has 356 + 330 + 328 elements", "[fabric]") {
  const SpringLattice lattice =
      spring_lattice(sheet_with_aspect(15, 11, 1), library_fabric("wool"));
  const auto n_shear =
      std::count_if(lattice.springs.begin(), lattice.springs.end(),
                    [](const Spring& spring) { return spring.kind == SpringKind::shear; });
  CHECK(lattice.springs.size() - static_cast<std::size_t>(n_shear) == 356);
  CHECK(n_shear == 330);
  CHECK(lattice.bends.size() == 328);
}

TEST_CASE("spring_lattice: a refined sheet has the springs of the finer grid", "[fabric]") {
  QuadMesh refined = sheet_with_aspect(3, 4, 1.1);
  refined.refine_uniformly(2);
  const SpringLattice found = spring_lattice(refined, library_fabric("wool"));
  const SpringLattice expected =
      spring_lattice(sheet_with_aspect(12, 16, 1.1), library_fabric("wool"));
  REQUIRE(found.springs.size() == expected.springs.size());
  REQUIRE(found.bends.size() == expected.bends.size());
  const auto sorted_stiffness = [](const auto& elements) {
    std::vector<double> stiffness;
    for (const auto& element : elements) stiffness.push_back(element.stiffness);
    std::sort(stiffness.begin(), stiffness.end());
    return stiffness;
  };
  const std::vector<double> found_springs = sorted_stiffness(found.springs);
  const std::vector<double> expected_springs = sorted_stiffness(expected.springs);
  for (std::size_t s = 0; s < found_springs.size(); ++s)
    REQUIRE(found_springs[s] == Approx(expected_springs[s]).epsilon(1e-9));
  const std::vector<double> found_bends = sorted_stiffness(found.bends);
  const std::vector<double> expected_bends = sorted_stiffness(expected.bends);
  for (std::size_t b = 0; b < found_bends.size(); ++b)
    REQUIRE(found_bends[b] == Approx(expected_bends[b]).epsilon(1e-9));
}

TEST_CASE("spring_lattice: the sheet weighs its areal density times its area", "[fabric]") {
  const int cells = GENERATE(1, 8, 33);
  const FabricConstants fabric = library_fabric("wool");
  const QuadMesh mesh = sheet_with_aspect(cells, cells, 1.2);
  CHECK(spring_lattice(mesh, fabric).masses.sum() ==
        Approx(1.2 * fabric.areal_density).epsilon(1e-12));
}

TEST_CASE("spring_lattice: damping is the reference time of the damping ratio times k",
          "[fabric]") {
  // Critical damping of a swing at omega is c = 2 k / omega; the fabric has zeta of that at 5 Hz.
  const FabricConstants fabric = library_fabric("wool");
  for (const Spring& spring : spring_lattice(square_sheet(3), fabric).springs)
    CHECK(spring.damping ==
          Approx(2 * fabric.damping_ratio / (2 * 3.14159265358979 * 5) * spring.stiffness));
}

}  // namespace pleat
