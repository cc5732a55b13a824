#include <catch2/catch.hpp>

#include "core/modal/full_arap.h"
#include "core/modal/modal_body.h"
#include "core/modal/reduced_arap.h"
#include "core/modal/shape_clusters.h"
#include "native-tests/support/bars.h"
#include "native-tests/support/meshes.h"

using namespace pleat;

namespace {

Positions about_centroid(const Positions& places, const Eigen::VectorXd& masses) {
  return places.colwise() - (places * masses / masses.sum()).eval();
}

}  // namespace

// A space of as many functions as there are vertices, and a cluster for each tetrahedron, leave
// nothing out.
TEST_CASE("middle: the reduced one is the full one where nothing is reduced", "[modal]") {
  const TetMesh mesh = bar_volume({0.4, 0.1, 0.1}, 0.1).volume;
  const int n = mesh.n_vertices();
  const Eigen::VectorXd masses = vertex_volumes(mesh);
  Modes modes;
  REQUIRE(volume_modes(mesh, 3 * n - 6, modes).ok());
  const ShapeSpace space = shape_space(mesh.rest_positions, masses, {modes}, {}, n, 0);
  REQUIRE(space.size() == n);
  std::vector<int> own(mesh.tets.size());
  for (std::size_t t = 0; t < own.size(); ++t) own[t] = static_cast<int>(t);
  const ReducedArap reduced(mesh, space, own);
  const FullArap full(mesh);
  CHECK(reduced.scale() == Approx(full.scale()));

  const Positions a = mesh.rest_positions;
  const Positions b = bent(mesh.rest_positions, 2.5);
  const ReducedArap::Key key_a = reduced.key(space.coordinates(a));
  const ReducedArap::Key key_b = reduced.key(space.coordinates(b));
  const MiddleShape of_reduced = middle_shape(*reduced.blend(key_a, key_b), reduced.scale());
  const MiddleShape of_full = middle_shape(*full.blend(a, b), full.scale());
  CHECK(of_reduced.converged);
  CHECK(of_full.converged);
  CHECK(of_reduced.distances.from_a == Approx(of_full.distances.from_a).epsilon(1e-3));
  CHECK(of_full.unequal_halves() < 0.01);
  const Positions x = about_centroid(space.positions(of_reduced.shape), masses);
  CHECK((x - about_centroid(of_full.shape, masses)).cwiseAbs().maxCoeff() < 1e-6);
}

// With halves that are alike, neither more of one key nor of the other comes to a smaller sum.
TEST_CASE("middle: the sum of its distances is the least near it", "[modal]") {
  const TetMesh mesh = bar_volume({0.4, 0.1, 0.1}, 0.05).volume;
  const Positions b = bent(mesh.rest_positions, 2);
  const FullArap full(mesh);
  const auto blend = full.blend(mesh.rest_positions, b);
  const MiddleShape middle = middle_shape(*blend, full.scale());
  CHECK(middle.unequal_halves() < 0.01);
  Positions gradient_a, gradient_b;
  const auto sum = [&](const Positions& x) {
    const auto [from_a, from_b] = blend->distances(x, gradient_a, gradient_b);
    return from_a + from_b;
  };
  const double least = sum(middle.shape);
  // At the least sum on a path where both change alike, their gradients point against each other.
  CHECK(std::abs(gradient_a.cwiseProduct(gradient_b).sum()) >
        0.9 * gradient_a.norm() * gradient_b.norm());
  for (const double step : {-0.01, 0.01}) {
    Positions stretched = middle.shape;
    stretched.row(0) *= 1 + step;
    CHECK(sum(stretched) > least);
  }
}

TEST_CASE("middle: gradients are those of the distances", "[modal]") {
  const TetMesh mesh = bar_volume({0.4, 0.1, 0.1}, 0.1).volume;
  Modes modes;
  REQUIRE(volume_modes(mesh, 8, modes).ok());
  const ShapeSpace space = shape_space(mesh.rest_positions, vertex_volumes(mesh), {modes}, {}, 16);
  const ReducedArap reduced(mesh, space, shape_clusters(mesh, space, 5));
  const Positions other = bent(mesh.rest_positions, 2);
  const FullArap full(mesh);
  const ReducedArap::Key a = reduced.key(space.coordinates(mesh.rest_positions));
  const ReducedArap::Key b = reduced.key(space.coordinates(other));
  Random random(2);
  const auto check = [&](const ArapBlend& blend, const ShapeCoordinates& start) {
    const ShapeCoordinates x = shaken(start, 0.01, random);
    ShapeCoordinates gradient_a, gradient_b, unused;
    blend.distances(x, gradient_a, gradient_b);
    constexpr double kStep = 1e-5;
    for (Eigen::Index column = 1; column < x.cols(); column += 4)
      for (int axis = 0; axis < 3; ++axis) {
        ShapeCoordinates more = x, less = x;
        more(axis, column) += kStep;
        less(axis, column) -= kStep;
        const auto after = blend.distances(more, unused, unused);
        const auto before = blend.distances(less, unused, unused);
        CHECK(gradient_a(axis, column) ==
              Approx((after.from_a - before.from_a) / (2 * kStep)).margin(1e-8));
        CHECK(gradient_b(axis, column) ==
              Approx((after.from_b - before.from_b) / (2 * kStep)).margin(1e-8));
      }
  };
  check(*full.blend(mesh.rest_positions, other), mesh.rest_positions);
  check(*reduced.blend(a, b), a.shape);
}
