#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "core/base/random.h"
#include "core/fabric/spring_lattice.h"
#include "core/mesh/mesh_lines.h"
#include "core/model/elasticity.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr int kCells = 12;  // cells of each side

QuadMesh square_sheet() {
  SheetShape shape;
  shape.columns = kCells;
  shape.rows = kCells;
  return QuadMesh::sheet(shape);
}

/// Faces whose middle lies in the part of the sheet that `is_inside` (u, v) tells, split once more.
template <class IsInside>
void refine_inside(QuadMesh& mesh, IsInside&& is_inside) {
  std::vector<FaceId> faces;
  for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
    const QuadFace& face = mesh.faces()[f];
    if (!face.active()) continue;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const VertexId v : face.corners) middle += mesh.rest_coordinates().col(v) / 4;
    if (is_inside(middle[0], middle[1])) faces.emplace_back(static_cast<std::int64_t>(f));
  }
  mesh.refine(faces);
}

QuadMesh randomly_refined_sheet(std::uint64_t seed) {
  Random random(seed);
  QuadMesh mesh = square_sheet();
  for (int i = 0; i < 30; ++i)
    mesh.refine(std::array{FaceId(random.below(static_cast<std::int64_t>(mesh.faces().size())))});
  return mesh;
}

/// Hanging vertices in the middle of their parents.
void place_hanging(const QuadMesh& mesh, Positions& x) {
  for (const HangingVertex& h : mesh.hanging_vertices())
    x.col(h.vertex) = (x.col(h.parents[0]) + x.col(h.parents[1])) / 2;
}

/// The mesh on a cylinder of this radius [m], rolled along warp (u) or weft (v).
Positions rolled(const QuadMesh& mesh, double radius, bool along_warp) {
  Positions x(3, mesh.n_vertices());
  for (int i = 0; i < mesh.n_vertices(); ++i) {
    const Eigen::Vector2d uv = mesh.rest_coordinates().col(i);
    const double around = along_warp ? uv[0] : uv[1];
    const double across = along_warp ? uv[1] : uv[0];
    x.col(i) << radius * std::sin(around / radius), across, radius * std::cos(around / radius);
  }
  place_hanging(mesh, x);
  return x;
}

double bending_energy(const SpringLattice& lattice, const Positions& x) {
  ClothModel bends_alone;
  bends_alone.bends = lattice.bends;
  return elastic_energy(bends_alone, x);
}

FabricConstants equal_bending() {
  FabricConstants fabric = library_fabric("wool");
  fabric.bend_warp = fabric.bend_weft = 1e-5;
  return fabric;
}

/// The energy is within 5 % of those of uniform sheets: these differ by the half cells at the ends
/// of lines, in which no chord has its middle.
void check_between_uniform(const QuadMesh& graded, int finest, double radius, bool along_warp) {
  const FabricConstants fabric = equal_bending();
  const auto energy = [&](const QuadMesh& mesh) {
    return bending_energy(spring_lattice(mesh, fabric), rolled(mesh, radius, along_warp));
  };
  QuadMesh fine = square_sheet();
  fine.refine_uniformly(finest);
  const double coarse_energy = energy(square_sheet());
  CHECK(energy(graded) > 0.95 * coarse_energy);
  CHECK(energy(graded) < 1.05 * energy(fine));
}

}  // namespace

TEST_CASE("graded lattice: an affine stretch is the same on any graded mesh", "[fabric]") {
  const int seed = GENERATE(1, 2, 3);
  CAPTURE(seed);
  const FabricConstants fabric = library_fabric("coarse cotton (denim)");
  const QuadMesh graded = randomly_refined_sheet(static_cast<std::uint64_t>(seed));
  REQUIRE(graded.hanging_vertices().size() > 20);
  Eigen::Matrix<double, 3, 2> gradient;
  gradient << 1.03, 0.02, -0.01, 0.98, 0.1, 0.05;
  const auto stretched = [&](const QuadMesh& mesh) {
    return Positions(gradient * mesh.rest_coordinates());
  };
  const auto model = [&](const QuadMesh& mesh) {
    ClothModel springs_alone;
    springs_alone.springs = spring_lattice(mesh, fabric, BendingLaw::none).springs;
    return springs_alone;
  };
  const QuadMesh base = square_sheet();
  CHECK(elastic_energy(model(graded), stretched(graded)) ==
        Approx(elastic_energy(model(base), stretched(base))).epsilon(1e-10));

  Positions forces = Positions::Zero(3, graded.n_vertices());
  add_elastic_forces(model(graded), stretched(graded), forces);
  const double largest = forces.cwiseAbs().maxCoeff();
  for (const HangingVertex& h : graded.hanging_vertices()) {
    for (const VertexId parent : h.parents) forces.col(parent) += forces.col(h.vertex) / 2;
    forces.col(h.vertex).setZero();
  }
  for (int i = 0; i < graded.n_vertices(); ++i) {
    const Eigen::Vector2d uv = graded.rest_coordinates().col(i);
    if (uv.minCoeff() > 0 && uv.maxCoeff() < 1) CHECK(forces.col(i).norm() < 1e-10 * largest);
  }
}

TEST_CASE("graded lattice: rolled on a cylinder it has the uniform sheet's bending energy",
          "[fabric]") {
  const bool along_warp = GENERATE(true, false);
  const int border = GENERATE(0, 1, 2, 5, 6, 7, 10, 11, 12);
  const bool border_across_warp = GENERATE(true, false);
  CAPTURE(along_warp, border, border_across_warp);
  const double radius = 0.4;  // 0.21 rad a coarse edge
  QuadMesh graded = square_sheet();
  const double limit = static_cast<double>(border) / kCells;
  refine_inside(graded, [&](double u, double v) { return (border_across_warp ? u : v) < limit; });
  check_between_uniform(graded, 1, radius, along_warp);
}

TEST_CASE("graded lattice: patches of any shape bend like the uniform sheet", "[fabric]") {
  const int seed = GENERATE(4, 5, 6, 7);
  const bool along_warp = GENERATE(true, false);
  CAPTURE(seed, along_warp);
  Random random(static_cast<std::uint64_t>(seed));
  const Eigen::Vector2d centre(random.uniform(0, 1), random.uniform(0, 1));
  QuadMesh graded = square_sheet();
  for (const double radius : {0.45, 0.25})
    refine_inside(graded, [&](double u, double v) {
      return (Eigen::Vector2d(u, v) - centre).norm() < radius;
    });
  check_between_uniform(graded, 2, 0.4, along_warp);
}

TEST_CASE("graded lattice: a flat sheet does not bend at its borders", "[fabric]") {
  const QuadMesh graded = randomly_refined_sheet(8);
  const SpringLattice lattice = spring_lattice(graded, equal_bending());
  const double scale = bending_energy(lattice, rolled(graded, 0.4, true));
  CHECK(bending_energy(lattice, graded.rest_positions()) < 1e-20 * scale);
}

TEST_CASE("graded lattice: no chord has a hanging vertex in its middle", "[fabric]") {
  const QuadMesh graded = randomly_refined_sheet(9);
  std::set<int> hanging;
  for (const HangingVertex& h : graded.hanging_vertices()) hanging.insert(h.vertex);
  int n_hanging_ends = 0;
  for (const BendElement& bend : spring_lattice(graded, equal_bending()).bends) {
    CHECK(hanging.count(bend.vertices[1]) == 0);
    n_hanging_ends +=
        static_cast<int>(hanging.count(bend.vertices[0]) + hanging.count(bend.vertices[2]));
  }
  CHECK(n_hanging_ends > 0);
}

TEST_CASE("graded lattice: springs of finer faces stiffen by the exponent", "[fabric]") {
  QuadMesh fine = square_sheet();
  fine.refine_uniformly(2);
  const FabricConstants fabric = library_fabric("coarse cotton (denim)");
  const auto plain = spring_lattice(fine, fabric).springs;
  const auto stiffened = spring_lattice(fine, fabric, BendingLaw::quadratic, 0.5).springs;
  REQUIRE(plain.size() == stiffened.size());
  for (std::size_t s = 0; s < plain.size(); ++s)
    CHECK(stiffened[s].stiffness == Approx(2 * plain[s].stiffness).epsilon(1e-14));
}

}  // namespace pleat
