#include "core/modal/arap_energy.h"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/random.h"
#include "core/modal/carrying_volume.h"
#include "native-tests/support/bars.h"
#include "native-tests/support/meshes.h"

using namespace pleat;

namespace {

Eigen::MatrixXd full(const SparseMatrix& lower) {
  return Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
}

}  // namespace

TEST_CASE("arap_energy: a rigid motion costs nothing, a stretch what its closed form says",
          "[modal]") {
  const CarryingVolume bar = bar_volume({0.4, 0.1, 0.2}, 0.1);
  const Positions& rest = bar.volume.rest_positions;
  const ArapEnergy energy(bar.volume, 3);
  const Mat3 turn = Eigen::AngleAxisd(2.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Positions turned = (turn * rest).colwise() + Vec3(0.3, -1, 2);
  CHECK(energy.energy(turned) < 1e-24);
  // w V (s - 1)^2.
  Positions stretched = rest;
  stretched.row(0) *= 1.2;
  CHECK(energy.energy(turn * stretched) == Approx(3 * 0.008 * 0.04));
  // Turned inside out, its nearest rotation is half a turn about y or z away: (-1 - 1)^2 in one.
  Positions mirrored = rest;
  mirrored.row(0) *= -1;
  CHECK(energy.energy(mirrored) == Approx(3 * 0.008 * 4));
}

TEST_CASE("arap_energy: gradient and Hessian are the differences of the energy", "[modal]") {
  const CarryingVolume bar = bar_volume({0.2, 0.1, 0.1}, 0.1);
  const ArapEnergy energy(bar.volume, 2);
  Random random(7);
  const Positions x = shaken(bar.volume.rest_positions, 0.02, random);
  Positions gradient;
  energy.energy_and_gradient(x, gradient);
  const Eigen::MatrixXd hessian = full(energy.hessian(x));
  constexpr double kStep = 1e-6;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    Positions ahead = x;
    Positions behind = x;
    ahead.data()[i] += kStep;
    behind.data()[i] -= kStep;
    Positions g_ahead;
    Positions g_behind;
    const double difference =
        energy.energy_and_gradient(ahead, g_ahead) - energy.energy_and_gradient(behind, g_behind);
    CHECK(difference / (2 * kStep) == Approx(gradient.data()[i]).margin(1e-9));
    const Positions column = (g_ahead - g_behind) / (2 * kStep);
    CHECK((flat(column) - hessian.col(i)).norm() < 1e-6 * hessian.norm());
  }
}

TEST_CASE("arap_energy: at rest nothing but the rigid motions of each part is free", "[modal]") {
  TetMesh two = bar_volume({0.2, 0.1, 0.1}, 0.1).volume;
  const TetMesh one = two;
  const int n = one.n_vertices();
  two.rest_positions.conservativeResize(3, 2 * n);
  two.rest_positions.rightCols(n) = one.rest_positions.colwise() + Vec3(0, 1, 0);
  for (Tet tet : one.tets) {
    for (VertexId& corner : tet) corner = VertexId(corner + n);
    two.tets.push_back(tet);
  }
  for (const TetMesh* mesh : {&one, static_cast<const TetMesh*>(&two)}) {
    const SparseMatrix hessian = ArapEnergy(*mesh, 1).hessian(mesh->rest_positions);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> values(full(hessian),
                                                                Eigen::EigenvaluesOnly);
    const double largest = values.eigenvalues().tail<1>()[0];
    const auto n_free = (values.eigenvalues().array() < 1e-12 * largest).count();
    CHECK(n_free == (mesh == &one ? 6 : 12));
    CHECK(values.eigenvalues()[0] > -1e-12 * largest);
    CHECK(values.eigenvalues()[n_free] > 1e-6 * largest);
  }
}
