#include "core/deform/deform_energy.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/base/random.h"
#include "core/deform/cloth_extent.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/finite_difference.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

constexpr std::array<EnergyForm, 2> kForms = {EnergyForm::consistent, EnergyForm::published};
const DeformWeights kWeights = {0.5, 0.3, 0.2};
constexpr double kEdge = 0.1;

TriangleMesh flat_mesh() { return triangulated_sheet(Triangulation::jittered, 3, 3, kEdge); }

/// A mesh that is bent at rest, with threads in the planes of its faces.
TriangleMesh bent_mesh() {
  TriangleMesh mesh = flat_mesh();
  mesh.rest_positions = on_cylinder(mesh.rest_positions, 0.4, 2 * kEdge);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    mesh.warp_directions[f] =
        direction_in_plane(mesh.warp_directions[f], mesh.rest_positions.col(t[0]),
                           mesh.rest_positions.col(t[1]), mesh.rest_positions.col(t[2]));
  }
  return mesh;
}

Positions moved(const Positions& x) {
  return (Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix() * x).colwise() +
         Vec3(3, -1, 2);
}

double energy_at(const DeformEnergy& energy, const Eigen::VectorXd& x) {
  return energy.terms(x.reshaped(3, x.size() / 3)).weighted(kWeights);
}

Eigen::VectorXd gradient_at(const DeformEnergy& energy, const Eigen::VectorXd& x) {
  return energy.gradient(kWeights, x.reshaped(3, x.size() / 3)).reshaped();
}

Eigen::MatrixXd metric_at(const DeformEnergy& energy, const Positions& x) {
  return Eigen::MatrixXd(energy.metric(kWeights, x)).selfadjointView<Eigen::Lower>();
}

/// The mean of the three coordinates' blocks of a matrix of all.
Eigen::MatrixXd mean_over_directions(const Eigen::MatrixXd& all) {
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(all.rows() / 3, all.cols() / 3);
  for (Eigen::Index i = 0; i < mean.rows(); ++i)
    for (Eigen::Index j = 0; j < mean.cols(); ++j)
      mean(i, j) = all.block<3, 3>(3 * i, 3 * j).trace() / 3;
  return mean;
}

/// Flat, rolled up, shaken, and with one half folded onto the other by almost a half turn.
std::vector<Positions> shapes(const TriangleMesh& mesh) {
  Random random(3);
  Positions folded = mesh.rest_positions;
  const double middle = folded.row(0).mean();
  for (Eigen::Index v = 0; v < folded.cols(); ++v) {
    if (folded(0, v) < middle) continue;
    folded(0, v) = 2 * middle - folded(0, v);
    folded(2, v) += 1e-3 * kEdge;
  }
  return {mesh.rest_positions, moved(mesh.rest_positions),
          shaken(mesh.rest_positions, 0.4 * kEdge, random), folded};
}

}  // namespace

TEST_CASE("deform_energy: the gradient is the energy's derivative", "[deform]") {
  const EnergyForm form = GENERATE(from_range(kForms));
  const TriangleMesh mesh = GENERATE(0, 1) == 0 ? flat_mesh() : bent_mesh();
  DeformEnergy energy(mesh, form);
  energy.hold({VertexId(0), VertexId(5)});
  for (const Positions& x : shapes(mesh)) {
    const Eigen::VectorXd found = gradient_at(energy, x.reshaped());
    const Eigen::VectorXd expected =
        difference_gradient([&](const Eigen::VectorXd& at) { return energy_at(energy, at); },
                            x.reshaped(), difference_step(1e-2 * kEdge));
    // The stiffness is all that there is to be relative to at rest.
    const double scale = std::max(expected.norm(), metric_at(energy, x).norm() * kEdge);
    CHECK((found - expected).norm() < 1e-6 * scale);
  }
}

TEST_CASE("deform_energy: at rest the metric is the second derivative, averaged over directions",
          "[deform]") {
  const EnergyForm form = GENERATE(from_range(kForms));
  const TriangleMesh mesh = flat_mesh();
  const DeformEnergy energy(mesh, form);
  const Eigen::MatrixXd expected =
      difference_jacobian([&](const Eigen::VectorXd& at) { return gradient_at(energy, at); },
                          mesh.rest_positions.reshaped(), difference_step(1e-2 * kEdge));
  CHECK(relative_error(metric_at(energy, mesh.rest_positions), mean_over_directions(expected)) <
        1e-6);
}

TEST_CASE("deform_energy: under tension the metric is the second derivative's mean too",
          "[deform]") {
  const DeformWeights stretch = {0, 1, 0};
  const EnergyForm form = GENERATE(from_range(kForms));
  const TriangleMesh mesh = flat_mesh();
  const DeformEnergy energy(mesh, form);
  const Positions x = 1.2 * mesh.rest_positions;
  const Eigen::MatrixXd expected = difference_jacobian(
      [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
        return energy.gradient(stretch, at.reshaped(3, at.size() / 3)).reshaped();
      },
      x.reshaped(), difference_step(1e-2 * kEdge));
  const Eigen::MatrixXd found =
      Eigen::MatrixXd(energy.metric(stretch, x)).selfadjointView<Eigen::Lower>();
  CHECK(relative_error(found, mean_over_directions(expected)) < 1e-6);
}

TEST_CASE("deform_energy: the metric is never indefinite", "[deform]") {
  const EnergyForm form = GENERATE(from_range(kForms));
  const TriangleMesh mesh = bent_mesh();
  const DeformEnergy energy(mesh, form);
  for (const Positions& x : shapes(mesh)) {
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(metric_at(energy, x)).eigenvalues();
    CHECK(values.minCoeff() > -1e-12 * values.maxCoeff());
  }
}

TEST_CASE("deform_energy: rest costs nothing, and moving it only what brings it back", "[deform]") {
  const EnergyForm form = GENERATE(from_range(kForms));
  const TriangleMesh mesh = GENERATE(0, 1) == 0 ? flat_mesh() : bent_mesh();
  const DeformEnergy energy(mesh, form);
  const DeformTerms rest = energy.terms(mesh.rest_positions);
  CHECK(rest.recovery == 0);
  CHECK(rest.stretch < 1e-20);
  CHECK(rest.bending < 1e-20);
  Random random(4);
  const Positions bent = shaken(mesh.rest_positions, 0.3 * kEdge, random);
  const DeformTerms here = energy.terms(bent);
  const DeformTerms there = energy.terms(moved(bent));
  CHECK(there.stretch == Approx(here.stretch).epsilon(1e-9));
  CHECK(there.bending == Approx(here.bending).epsilon(1e-9));
  CHECK(there.recovery > 2 * here.recovery);
}

TEST_CASE("deform_energy: the published sums are what a hand counts", "[deform]") {
  TriangleMesh mesh;  // two right triangles on a square's diagonal
  mesh.rest_positions.resize(3, 4);
  mesh.rest_positions << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  mesh.triangles = {{VertexId(0), VertexId(1), VertexId(2)},
                    {VertexId(0), VertexId(2), VertexId(3)}};
  DeformEnergy energy(mesh, EnergyForm::published);
  const double unit = (4 + std::sqrt(2.0)) / 5;
  Positions x = mesh.rest_positions;
  x.col(1) << 0.5, 0.5, std::sqrt(0.5);  // its triangle stands upright on the diagonal
  energy.hold({VertexId(0)});
  const DeformTerms terms = energy.terms(x);
  CHECK(terms.recovery == Approx(1 / (unit * unit)));
  CHECK(terms.stretch == Approx(0).margin(1e-25));
  CHECK(terms.bending == Approx(kPi * kPi / 4));
  x.col(3) *= 2;
  const double diagonal = std::hypot(1, 1);
  CHECK(energy.terms(x).stretch == Approx((1 + std::pow(diagonal - 1, 2)) / (unit * unit)));
  energy.hold({VertexId(1)});
  CHECK(energy.terms(x).recovery == Approx(1 / (unit * unit)));
}

TEST_CASE("deform_energy: integrals are those of their closed forms on any mesh", "[deform]") {
  const Triangulation pattern = GENERATE(from_range(kTriangulations));
  CAPTURE(pattern);
  const TriangleMesh mesh = triangulated_sheet(pattern, 12, 12, kEdge);
  const DeformEnergy energy(mesh, EnergyForm::consistent);
  const Positions& rest = mesh.rest_positions;
  const double area = vertex_areas(mesh).sum();
  const double unit = cloth_extent(mesh) / 20;
  Eigen::Matrix3d F;
  F << 1.2, 0.1, 0, 0, 0.9, 0, 0, 0, 1;
  const Eigen::Matrix2d C = (F.transpose() * F).topLeftCorner<2, 2>();
  const Eigen::Matrix2d E = (C - Eigen::Matrix2d::Identity()) / 2;
  const double density = E.squaredNorm() + E.trace() * E.trace() / 2;
  CHECK(energy.terms(F * rest).stretch == Approx(area * density / (unit * unit)).epsilon(1e-9));
  const Positions shifted = rest.colwise() + Vec3(0, 0, 0.3);
  CHECK(energy.terms(shifted).recovery == Approx(area * 0.09 / std::pow(unit, 4)).epsilon(1e-9));
  const double radius = 12 * kEdge;
  CHECK(energy.terms(on_cylinder(rest, 0.3, radius)).bending ==
        Approx(area / (radius * radius)).epsilon(0.005));
}

TEST_CASE("deform_energy: the vertices' shares of bending add up, and lie where it is bent",
          "[deform]") {
  const EnergyForm form = GENERATE(from_range(kForms));
  const TriangleMesh mesh = triangulated_sheet(Triangulation::equilateral, 8, 8, kEdge);
  const DeformEnergy energy(mesh, form);
  Positions x = mesh.rest_positions;
  const double middle = x.row(0).mean();
  for (Eigen::Index v = 0; v < x.cols(); ++v) x(2, v) = std::max(0.0, x(0, v) - middle);
  const Eigen::VectorXd shares = energy.bending_shares(x);
  CHECK(shares.sum() == Approx(energy.terms(x).bending));
  for (Eigen::Index v = 0; v < x.cols(); ++v)
    if (std::abs(x(0, v) - middle) > 2.5 * kEdge) CHECK(shares[v] < 1e-20);
}

TEST_CASE("deform_energy: faces and hinges without area have finite gradients", "[deform]") {
  const EnergyForm form = GENERATE(from_range(kForms));
  const TriangleMesh mesh = bent_mesh();
  const DeformEnergy energy(mesh, form);
  Positions collapsed = mesh.rest_positions;
  collapsed.col(5) = collapsed.col(6);
  const Positions point = Positions::Zero(3, collapsed.cols());
  for (const Positions& x : {collapsed, point}) {
    CHECK(std::isfinite(energy.terms(x).weighted(kWeights)));
    CHECK(energy.gradient(kWeights, x).allFinite());
    CHECK(metric_at(energy, x).allFinite());
  }
}

TEST_CASE("deform_energy: a term without weight joins no vertices", "[deform]") {
  const EnergyForm form = GENERATE(from_range(kForms));
  const TriangleMesh mesh = flat_mesh();
  const DeformEnergy energy(mesh, form);
  const auto entries = [&](const DeformWeights& weights) {
    return energy.metric(weights, mesh.rest_positions).nonZeros();
  };
  CHECK(entries({1, 0, 0}) == mesh.n_vertices());
  CHECK(entries({1, 1, 0}) < entries({1, 1, 1}));
}

}  // namespace pleat
