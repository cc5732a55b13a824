#include "core/modal/modes.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/mesh/sheet_pattern.h"
#include "core/modal/arap_energy.h"
#include "core/modal/carrying_volume.h"
#include "core/modal/shown_modes.h"
#include "native-tests/support/bars.h"

using namespace pleat;

namespace {

constexpr double kYoung = 2e6;         // [Pa]
constexpr double kDensity = 1000;      // [kg/m^3]
const Vec3 kBar(1, 0.05, 0.075);       // [m]: bends about two axes at different frequencies
constexpr double kFree = 4.730041;     // first root of cos x cosh x = 1
constexpr double kClamped = 1.875104;  // first root of cos x cosh x = -1

Eigen::VectorXd masses_of(const TetMesh& mesh) {
  const Eigen::VectorXd masses = kDensity * vertex_volumes(mesh);
  return masses.replicate(1, 3).transpose().reshaped();
}

/// Lower and higher first bending frequency [rad/s] of a slender bar: root^2 sqrt(E I / (rho A
/// L^4)), I / A = side^2 / 12.
std::array<double, 2> beam_frequencies(double root) {
  const auto of_side = [&](double side) {
    return root * root / (kBar.x() * kBar.x()) * side * std::sqrt(kYoung / (12 * kDensity));
  };
  return {of_side(kBar.y()), of_side(kBar.z())};
}

/// The lattice's own, with so many cubes through the thinner side.
std::array<double, 2> bar_frequencies(int cells, bool clamped) {
  const TetMesh mesh = bar_volume(kBar, kBar.y() / cells).volume;
  SparseMatrix stiffness = ArapEnergy(mesh, kYoung / 2).hessian(mesh.rest_positions);
  Eigen::VectorXd masses = masses_of(mesh);
  Eigen::MatrixXd rigid = rigid_motions(mesh.rest_positions, parts_by_vertices(mesh));
  if (clamped) {
    const double end = mesh.rest_positions.row(0).minCoeff() + 1e-9;
    std::vector<Eigen::Triplet<double, int>> kept;
    int n_kept = 0;
    for (int v = 0; v < mesh.n_vertices(); ++v)
      if (mesh.rest_positions(0, v) > end)
        for (int k = 0; k < 3; ++k) kept.emplace_back(n_kept++, 3 * v + k, 1);
    SparseMatrix keep(n_kept, masses.size());
    keep.setFromTriplets(kept.begin(), kept.end());
    const SparseMatrix whole = stiffness.selfadjointView<Eigen::Lower>();
    stiffness =
        SparseMatrix(keep * whole * SparseMatrix(keep.transpose())).triangularView<Eigen::Lower>();
    masses = keep * masses;
    rigid.resize(n_kept, 0);
  }
  Modes modes;
  const SolveReport report = lowest_modes(stiffness, masses, rigid, 2, modes);
  CHECK(report.ok());
  CHECK(modes.residuals.maxCoeff() < 1e-8);
  const auto frequency = [&](int m) { return std::sqrt(modes.stiffness[modes.n_rigid + m]); };
  return {frequency(0), frequency(1)};
}

}  // namespace

// Linear tetrahedra lock when they bend: the error falls with the square of their size, and is much
// the same for both ends.
TEST_CASE("modes: a slender bar swings as beam theory says", "[modal]") {
  const bool clamped = GENERATE(false, true);
  CAPTURE(clamped);
  const std::array<double, 2> beam = beam_frequencies(clamped ? kClamped : kFree);
  const std::array<double, 2> coarse = bar_frequencies(2, clamped);
  const std::array<double, 2> fine = bar_frequencies(4, clamped);
  for (std::size_t m = 0; m < 2; ++m) {
    CAPTURE(m, beam[m], coarse[m], fine[m]);
    CHECK(fine[m] < coarse[m]);
    CHECK(fine[m] - beam[m] < 0.4 * (coarse[m] - beam[m]));
    CHECK(fine[m] + (fine[m] - coarse[m]) / 3 == Approx(beam[m]).epsilon(0.03));
  }
}

TEST_CASE("modes: they are those of a dense solver, orthonormal, rigid ones first", "[modal]") {
  const TetMesh mesh = bar_volume({0.3, 0.2, 0.1}, 0.1).volume;
  const SparseMatrix stiffness = ArapEnergy(mesh, 1).hessian(mesh.rest_positions);
  const Eigen::VectorXd masses = masses_of(mesh);
  const Eigen::MatrixXd rigid = rigid_motions(mesh.rest_positions, parts_by_vertices(mesh));
  Modes modes;
  CHECK(lowest_modes(stiffness, masses, rigid, 12, modes).ok());
  REQUIRE(modes.size() == 18);
  CHECK(modes.n_rigid == 6);
  const Eigen::MatrixXd products = modes.shapes.transpose() * masses.asDiagonal() * modes.shapes;
  CHECK((products - Eigen::MatrixXd::Identity(18, 18)).cwiseAbs().maxCoeff() < 1e-10);
  CHECK(modes.residuals.maxCoeff() < 1e-8);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(
      Eigen::MatrixXd(Eigen::MatrixXd(stiffness).selfadjointView<Eigen::Lower>()),
      Eigen::MatrixXd(masses.asDiagonal()));
  for (int m = 6; m < 18; ++m)
    CHECK(modes.stiffness[m] == Approx(dense.eigenvalues()[m]).epsilon(1e-9));
}

// Second differences less a constant: stiffness below and above zero.
TEST_CASE("modes: they ascend through zero, and all of them can be had", "[modal]") {
  const int n = GENERATE(1, 2, 3, 12, 40);
  const int count = GENERATE_COPY(values({1, (n + 1) / 2, n}));
  CAPTURE(n, count);
  Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    chain(i, i) = 2 - 1.3;
    if (i > 0) chain(i, i - 1) = chain(i - 1, i) = -1;
  }
  const Eigen::VectorXd masses = Eigen::VectorXd::LinSpaced(n, 1, 2);
  Modes modes;
  CHECK(lowest_modes(SparseMatrix(chain.sparseView()).triangularView<Eigen::Lower>(), masses,
                     Eigen::MatrixXd(n, 0), count, modes)
            .ok());
  REQUIRE(modes.size() == count);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(
      chain, Eigen::MatrixXd(masses.asDiagonal()));
  for (int m = 0; m < count; ++m)
    CHECK(modes.stiffness[m] == Approx(dense.eigenvalues()[m]).epsilon(1e-9));
  const Eigen::MatrixXd products = modes.shapes.transpose() * masses.asDiagonal() * modes.shapes;
  CHECK((products - Eigen::MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("modes: both modes of a square's equal two are found, however few are asked for",
          "[modal]") {
  const TriangleMesh square = patterned_sheet({.columns = 6, .rows = 6}, SheetPattern::alternating);
  const int count = GENERATE(3, 4, 5, 8);
  CAPTURE(count);
  const SurfaceModes modes = surface_modes(square.rest_positions, square.triangles, count);
  REQUIRE(modes.size() >= 2);
  CHECK(modes.stiffness[1] == Approx(modes.stiffness[0]).epsilon(1e-6));
}

TEST_CASE("modes: disconnected parts have six rigid motions each, and their own shapes twice",
          "[modal]") {
  TetMesh two = bar_volume({0.3, 0.2, 0.1}, 0.1).volume;
  const int n = two.n_vertices();
  const std::vector<Tet> tets = two.tets;
  two.rest_positions.conservativeResize(3, 2 * n);
  two.rest_positions.rightCols(n) = two.rest_positions.leftCols(n).colwise() + Vec3(0, 0, 2);
  for (Tet tet : tets) {
    for (VertexId& corner : tet) corner = VertexId(corner + n);
    two.tets.push_back(tet);
  }
  const SparseMatrix stiffness = ArapEnergy(two, 1).hessian(two.rest_positions);
  Modes modes;
  CHECK(lowest_modes(stiffness, masses_of(two),
                     rigid_motions(two.rest_positions, parts_by_vertices(two)), 6, modes)
            .ok());
  CHECK(modes.n_rigid == 12);
  for (int m = 12; m < 18; m += 2)
    CHECK(modes.stiffness[m] == Approx(modes.stiffness[m + 1]).epsilon(1e-8));
}
