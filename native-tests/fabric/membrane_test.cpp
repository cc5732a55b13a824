#include "core/fabric/membrane.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/base/check.h"
#include "core/model/elasticity.h"
#include "native-tests/support/finite_difference.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr double kSide = 0.1;  // [m]
const MembraneLaw kLaw{60, 45, 8, 0};
const MembraneLaw kBilinear{60, 45, 8, 0.1};

using Mat9 = Eigen::Matrix<double, 9, 9>;

Membrane membrane_of(const TriangleMesh& mesh, const MembraneLaw& law) {
  return {law, membrane_elements(mesh)};
}

Positions forces_of(const Membrane& membrane, const Positions& x) {
  Positions forces = Positions::Zero(3, x.cols());
  add_membrane_forces(membrane, x, forces);
  return forces;
}

/// One material triangle of irregular shape, warp along x.
TriangleMesh lone_triangle() {
  TriangleMesh mesh;
  mesh.rest_positions.resize(3, 3);
  mesh.rest_positions << 0.1, 1.1, 0.4, 0.2, 0.0, 0.9, 0, 0, 0;
  mesh.triangles = {{VertexId(0), VertexId(1), VertexId(2)}};
  mesh.warp_directions = {Vec3::UnitX()};
  return mesh;
}

/// Homogeneous deformations: the image of the material plane z = 0.
Mat3 plane_map(double a, double b, double c, double d) {
  Mat3 map = Mat3::Identity();
  map.topLeftCorner<2, 2>() << a, b, c, d;
  return map;
}

/// Places of the three vertices, far from the stiffening strain of 0.1 on both sides of it.
std::vector<Positions> triangle_shapes() {
  const Positions rest = lone_triangle().rest_positions;
  std::vector<Positions> shapes;
  for (const Mat3& map :
       {plane_map(1.05, 0, 0, 1.02), plane_map(1.4, 0.2, 0, 1.3), plane_map(0.7, 0.1, 0.2, 0.8),
        plane_map(1.3, 0, 0, 0.6), plane_map(-1, 0, 0.3, 1.2), plane_map(1.2, 0.4, 0.6, 0.2)})
    shapes.emplace_back(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()) * map * rest);
  shapes.emplace_back(plane_map(1, 1, 0, 0) * rest);  // all on a line
  shapes.emplace_back(Positions::Zero(3, 3));         // all in a point
  Random random(3);
  for (int k = 0; k < 5; ++k) shapes.emplace_back(shaken(Positions::Zero(3, 3), 1, random));
  return shapes;
}

/// Sum over the border edges of a vertex of half the length times the outward normal [m].
Positions border_normals(const TriangleMesh& mesh) {
  Positions sum = Positions::Zero(3, mesh.n_vertices());
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    if (!edge.is_border()) continue;
    const Vec3 along = mesh.rest_positions.col(edge.b) - mesh.rest_positions.col(edge.a);
    for (const VertexId v : {edge.a, edge.b}) sum.col(v) += along.cross(Vec3::UnitZ()) / 2;
  }
  return sum;
}

}  // namespace

TEST_CASE("membrane: homogeneous strain has the closed form's energy and border forces",
          "[fabric]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  const auto [name, warp, weft, shear] = GENERATE(table<std::string, double, double, double>(
      {{"uniaxial", 1.2, 1, 0}, {"shear", 1, 1, 0.3}, {"biaxial", 1.1, 0.9, 0}}));
  CAPTURE(pattern, name);
  const TriangleMesh mesh = triangulated_sheet(pattern, 5, 6, kSide);
  const Membrane membrane = membrane_of(mesh, kLaw);
  const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(1, -1, 2).normalized()).toRotationMatrix();
  const Mat3 F = turn * plane_map(warp, shear, 0, weft);
  const Positions x = F * mesh.rest_positions;
  // 2 E = F^T F - I with the columns (warp, 0) and (shear, weft).
  const double e_u = (warp * warp - 1) / 2;
  const double e_v = (shear * shear + weft * weft - 1) / 2;
  const double g = warp * shear;
  const double density = 0.5 * (60 * e_u * e_u + 45 * e_v * e_v + 8 * (2 * e_u * e_v + g * g));
  CHECK(membrane_energy(membrane, x) == Approx(density * vertex_areas(mesh).sum()).epsilon(1e-12));
  Mat3 S = Mat3::Zero();
  S.topLeftCorner<2, 2>() << 60 * e_u + 8 * e_v, 8 * g, 8 * g, 45 * e_v + 8 * e_u;
  CHECK(relative_error(forces_of(membrane, x), Positions(-F * S * border_normals(mesh))) < 1e-12);
}

TEST_CASE("membrane: moving and turning costs nothing and pulls nowhere", "[fabric]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  CAPTURE(pattern);
  const TriangleMesh mesh = triangulated_sheet(pattern, 4, 4, kSide);
  const Membrane membrane = membrane_of(mesh, kBilinear);
  const Mat3 turn = Eigen::AngleAxisd(2.5, Vec3(3, 1, 2).normalized()).toRotationMatrix();
  const Positions moved = (turn * mesh.rest_positions).colwise() + Vec3(1, -2, 3);
  // Strains of 1e-14 are left by coordinates near 3 m over edges of 0.1 m.
  CHECK(membrane_energy(membrane, moved) < 1e-25);
  CHECK(forces_of(membrane, moved).norm() < 1e-11);
}

TEST_CASE("membrane: a sheet folded in space is at rest when its rest shape is", "[fabric]") {
  TriangleMesh mesh = triangulated_sheet(Triangulation::one_way, 1, 1, kSide);
  mesh.rest_positions.col(3) << 0, 0, kSide;
  mesh.warp_directions = {Vec3::UnitX(), Vec3(1, -1, 0).normalized()};
  const Membrane membrane = membrane_of(mesh, kLaw);
  CHECK(membrane_energy(membrane, mesh.rest_positions) < 1e-25);
  CHECK(membrane_energy(membrane, 1.1 * mesh.rest_positions) > 1e-3);
}

TEST_CASE("membrane: force is the energy's gradient, stiffness its second derivative", "[fabric]") {
  const MembraneLaw law = GENERATE(as<MembraneLaw>{}, kLaw, kBilinear);
  const Membrane membrane = membrane_of(lone_triangle(), law);
  for (const Positions& x : triangle_shapes()) {
    CAPTURE(law.stiffening_strain, x);
    const auto energy = [&](const Eigen::VectorXd& at) {
      return membrane_energy(membrane, at.reshaped(3, 3));
    };
    const auto force = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
      return forces_of(membrane, at.reshaped(3, 3)).reshaped();
    };
    const Eigen::VectorXd at = x.reshaped();
    const double step = difference_step(1);
    const Eigen::VectorXd slope = difference_gradient(energy, at, step);
    CHECK((force(at) + slope).norm() < 1e-8 * 60);
    const Mat9 K = membrane_stiffness(law, membrane.elements[0], x, ElementHessian::exact);
    CHECK((K + difference_jacobian(force, at, step)).norm() < 1e-8 * 60);
    CHECK((K - K.transpose()).norm() == 0);
  }
}

TEST_CASE("membrane: the projected stiffness is positive semidefinite and exact in tension",
          "[fabric]") {
  const MembraneLaw law = GENERATE(as<MembraneLaw>{}, kLaw, kBilinear);
  const MembraneElement element = membrane_elements(lone_triangle())[0];
  for (const Positions& x : triangle_shapes()) {
    CAPTURE(law.stiffening_strain, x);
    const Mat9 projected = membrane_stiffness(law, element, x, ElementHessian::projected);
    const Mat9 exact = membrane_stiffness(law, element, x, ElementHessian::exact);
    const Eigen::VectorXd values = projected.selfadjointView<Eigen::Lower>().eigenvalues();
    CHECK(values.minCoeff() >= -1e-13 * values.maxCoeff());
    // Dropping what is negative never takes away stiffness.
    const Mat9 dropped = projected - exact;
    CHECK(dropped.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() >= -1e-12 * 60);
  }
  const Positions taut = triangle_shapes()[1];
  CHECK(membrane_stiffness(law, element, taut, ElementHessian::projected) ==
        membrane_stiffness(law, element, taut, ElementHessian::exact));
}

TEST_CASE("membrane: stress of one sign in one direction is projected by its own part",
          "[fabric]") {
  // Pulled along warp, pressed along weft: only the pull resists a move out of the plane.
  const MembraneElement element = membrane_elements(lone_triangle())[0];
  const Positions x = plane_map(1.3, 0, 0, 0.6) * lone_triangle().rest_positions;
  const Mat9 K = membrane_stiffness(kLaw, element, x, ElementHessian::projected);
  const double s_u = 60 * (1.3 * 1.3 - 1) / 2 + 8 * (0.6 * 0.6 - 1) / 2;
  for (int i = 0; i < 3; ++i)
    CHECK(K(3 * i + 2, 3 * i + 2) ==
          Approx(element.area * s_u * std::pow(element.gradients(i, 0), 2)).epsilon(1e-12));
}

TEST_CASE("membrane: beyond the stiffening strain a thread is ten times as stiff, in tension only",
          "[fabric]") {
  const bool is_warp = GENERATE(true, false);
  CAPTURE(is_warp);
  const Membrane membrane = membrane_of(lone_triangle(), kBilinear);
  const double K = is_warp ? 60 : 45;
  const auto energy = [&](double strain) {
    const double l = 1 + strain;
    return membrane_energy(membrane, plane_map(is_warp ? l : 1, 0, 0, is_warp ? 1 : l) *
                                         lone_triangle().rest_positions) /
           membrane.elements[0].area;
  };
  const auto green = [](double strain) { return strain + strain * strain / 2; };
  CHECK(energy(-0.3) == Approx(0.5 * K * std::pow(green(-0.3), 2)).epsilon(1e-12));
  CHECK(energy(0.1) == Approx(0.5 * K * std::pow(green(0.1), 2)).epsilon(1e-12));
  CHECK(energy(0.25) ==
        Approx(0.5 * K * std::pow(green(0.25), 2) + 4.5 * K * std::pow(green(0.25) - green(0.1), 2))
            .epsilon(1e-12));
}

TEST_CASE("membrane: springs store the same in small strain", "[fabric]") {
  const double aspect = GENERATE(0.7, 1.0, 1.4);
  const std::string name = GENERATE("fine cotton", "leather", "spandex");
  CAPTURE(aspect, name);
  const QuadMesh sheet = sheet_with_aspect(8, 8, aspect);
  const FabricConstants fabric = library_fabric(name);
  const ClothModel springs = sheet_model(sheet, fabric);
  const Membrane membrane = membrane_of(sheet.triangle_mesh(), membrane_law(fabric));
  constexpr double kStrain = 1e-4;  // terms of its third order cancel between signs
  for (const auto& [u, v, g] : {std::tuple(1.0, 0.0, 0.0),
                                {0.0, 1.0, 0.0},
                                {0.0, 0.0, 1.0},
                                {1.0, 1.0, 0.0},
                                {1.0, -1.0, 0.5}}) {
    CAPTURE(u, v, g);
    double of_springs = 0;
    double of_membrane = 0;
    for (const double e : {kStrain, -kStrain}) {
      Mat3 map = Mat3::Zero();  // map from (u, v)
      map.topLeftCorner<2, 2>() << 1 + e * u, e * g / 2, e * g / 2, 1 + e * v;
      const Positions x = map.leftCols<2>() * sheet.rest_coordinates();
      of_springs += elastic_energy(springs, x);
      of_membrane += membrane_energy(membrane, x);
    }
    CHECK(of_springs == Approx(of_membrane).epsilon(1e-3));
  }
}

TEST_CASE("membrane: viscosity is the stiffness at rest and turns with the cloth", "[fabric]") {
  const MembraneElement element = membrane_elements(lone_triangle())[0];
  const Positions rest = lone_triangle().rest_positions;
  const Mat9 at_rest = membrane_viscosity(kBilinear, element, rest);
  CHECK(relative_error(at_rest, membrane_stiffness(kLaw, element, rest, ElementHessian::exact)) <
        1e-12);
  for (const Positions& x : triangle_shapes()) {
    CAPTURE(x);
    const Mat9 C = membrane_viscosity(kBilinear, element, x);
    CHECK(C.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() >= -1e-13 * C.norm());
    // A turn about the origin: velocities omega x r.
    Positions velocities(3, 3);
    for (int i = 0; i < 3; ++i) velocities.col(i) = Vec3(1, -2, 3).cross(x.col(i));
    CHECK((C * velocities.reshaped()).norm() <= 1e-13 * C.norm() * velocities.norm());
  }
}

TEST_CASE("membrane: a fabric that shears harder than it stretches is refused by its name",
          "[fabric]") {
  FabricConstants fabric = soft_fabric();
  fabric.shear = std::sqrt(fabric.stretch_warp * fabric.stretch_weft) * 1.01;
  try {
    membrane_law(fabric);
    FAIL("nothing was thrown");
  } catch (const InputError& error) {
    CHECK(error.sentence().find("soft") != std::string::npos);
    CHECK(error.where() == "/fabric");
  }
  for (const FabricConstants& measured : library_fabrics()) CHECK_NOTHROW(membrane_law(measured));
}

TEST_CASE("membrane: a triangle without area or warp is refused", "[fabric]") {
  TriangleMesh mesh = lone_triangle();
  mesh.rest_positions.col(2) = mesh.rest_positions.col(1);
  CHECK_THROWS_AS(membrane_elements(mesh), ContractError);
  mesh = lone_triangle();
  mesh.warp_directions.clear();
  CHECK_THROWS_AS(membrane_elements(mesh), ContractError);
}

}  // namespace pleat
