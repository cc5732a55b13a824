#include "core/modal/surface_arap.h"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "core/modal/modal_body.h"
#include "core/modal/nearest_rotation.h"
#include "native-tests/support/bars.h"
#include "native-tests/support/meshes.h"
#include "native-tests/support/models.h"

using namespace pleat;

namespace {

/// The energy itself, its rotations found afresh; weights are the cotangents' at rest.
double energy(const Positions& rest, const std::vector<Triangle>& triangles, const Positions& x) {
  std::vector<Eigen::Matrix3d> moments(static_cast<std::size_t>(rest.cols()), Mat3::Zero());
  struct Spoke {
    int centre, end;
    double weight;
  };
  std::vector<Spoke> spokes;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = t[k];
      const int b = t[(k + 1) % 3];
      const Vec3 p = rest.col(a) - rest.col(t[(k + 2) % 3]);
      const Vec3 q = rest.col(b) - rest.col(t[(k + 2) % 3]);
      const double half = p.dot(q) / p.cross(q).norm() / 2;
      spokes.push_back({a, b, half});
      spokes.push_back({b, a, half});
    }
  for (const auto& [a, b, w] : spokes)
    moments[static_cast<std::size_t>(a)] +=
        w * (x.col(b) - x.col(a)) * (rest.col(b) - rest.col(a)).transpose();
  double sum = 0;
  for (const auto& [a, b, w] : spokes)
    sum += w * ((x.col(b) - x.col(a)) - nearest_rotation(moments[static_cast<std::size_t>(a)]) *
                                            (rest.col(b) - rest.col(a)))
                   .squaredNorm();
  return sum;
}

}  // namespace

TEST_CASE("surface_arap: its Hessian is that of the energy", "[modal]") {
  const FineBox box({0.3, 0.2, 0.2}, 2);
  const Positions& rest = box.positions;
  const SparseMatrix hessian = surface_arap_hessian(rest, box.triangles, 1);
  Random random(4);
  for (int trial = 0; trial < 5; ++trial) {
    const Positions way = shaken(Positions::Zero(3, rest.cols()), 1, random);
    constexpr double kStep = 1e-5;
    const double along = (energy(rest, box.triangles, rest + kStep * way) +
                          energy(rest, box.triangles, rest - kStep * way)) /
                         (kStep * kStep);
    const Eigen::VectorXd pull = hessian.selfadjointView<Eigen::Lower>() * flat(way);
    CHECK(along == Approx(flat(way).dot(pull)).epsilon(1e-4));
  }
}

TEST_CASE("surface_arap: nothing but rigid motions is free", "[modal]") {
  const FineBox box({0.3, 0.2, 0.2}, 1);
  const Eigen::MatrixXd hessian = dense(surface_arap_hessian(box.positions, box.triangles, 1));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(hessian);
  const Eigen::VectorXd& values = eigen.eigenvalues();
  CHECK(values[5] < 1e-9 * values[values.size() - 1]);
  CHECK(values[6] > 1e-6 * values[values.size() - 1]);
  std::vector<int> parts(static_cast<std::size_t>(box.positions.cols()), 0);
  CHECK((hessian * rigid_motions(box.positions, parts)).cwiseAbs().maxCoeff() < 1e-9);
}

// The use of a volume: the softest mode of a long box's skin squashes what is inside.
TEST_CASE("surface_arap: a mode of the surface alone squashes what a volume keeps", "[modal]") {
  const FineBox box({1, 0.3, 0.3}, 3);
  const auto squashed = [&](const Positions& shape) {
    const double size = 0.02 / shape.colwise().norm().maxCoeff();
    double before = 0, after = 0;
    // The thickness along z of the middle third, where it is 0.3 m.
    for (Eigen::Index v = 0; v < box.positions.cols(); ++v) {
      if (std::abs(box.positions(0, v)) > 1.0 / 6) continue;
      before += std::abs(box.positions(2, v));
      after += std::abs(box.positions(2, v) + size * shape(2, v));
    }
    return std::abs(after / before - 1);
  };
  Modes volume, surface;
  ModalOptions options;
  options.size = 0.1;
  const CarryingVolume carrying = carrying_volume(box.positions, box.triangles, options);
  REQUIRE(volume_modes(carrying.volume, 4, volume).ok());
  const std::vector<int> parts(static_cast<std::size_t>(box.positions.cols()), 0);
  REQUIRE(lowest_modes(
              surface_arap_hessian(box.positions, box.triangles, 1),
              surface_areas(box.positions, box.triangles).replicate(1, 3).transpose().reshaped(),
              rigid_motions(box.positions, parts), 4, surface)
              .ok());
  double of_volume = 0, of_surface = 0;
  for (int m = 6; m < 10; ++m) {
    const Eigen::VectorXd v = volume.shapes.col(m);
    const Eigen::VectorXd s = surface.shapes.col(m);
    of_volume = std::max(
        of_volume,
        squashed(carrying.surface(Eigen::Map<const Positions>(v.data(), 3, v.size() / 3))));
    of_surface =
        std::max(of_surface, squashed(Eigen::Map<const Positions>(s.data(), 3, s.size() / 3)));
  }
  CAPTURE(of_volume, of_surface);
  CHECK(of_surface > 2 * of_volume);
}

TEST_CASE("surface_arap: areas are thirds of the triangles around", "[modal]") {
  const TriangleMesh sheet = triangulated_sheet(Triangulation::alternating, 4, 4, 0.25);
  const Eigen::VectorXd areas = surface_areas(sheet.rest_positions, sheet.triangles);
  CHECK(areas.sum() == Approx(1));
  CHECK(areas.isApprox(vertex_areas(sheet)));
}
