#include "core/modal/shape_space.h"

#include <catch2/catch.hpp>
#include <set>

#include "core/base/check.h"
#include "core/modal/modal_body.h"
#include "core/modal/shape_clusters.h"
#include "native-tests/support/bars.h"

using namespace pleat;

namespace {

const Vec3 kSides(1, 0.2, 0.2);

struct Bar {
  TetMesh mesh = bar_volume(kSides, 0.1).volume;
  Eigen::VectorXd masses = vertex_volumes(mesh);
  Modes modes;

  explicit Bar(int n_modes = 10) { REQUIRE(volume_modes(mesh, n_modes, modes).ok()); }

  ShapeSpace space(int most, const std::vector<Positions>& exact = {}) const {
    return shape_space(mesh.rest_positions, masses, {modes}, exact, most, 0);
  }
};

}  // namespace

TEST_CASE("shape_space: its functions are orthonormal, the heaviest first", "[modal]") {
  const Bar bar;
  const ShapeSpace space = bar.space(20);
  REQUIRE(space.size() == 20);
  const Eigen::MatrixXd products =
      space.functions * space.masses.asDiagonal() * space.functions.transpose();
  CHECK((products - Eigen::MatrixXd::Identity(20, 20)).cwiseAbs().maxCoeff() < 1e-10);
  CHECK((space.weights.head<kAffineFunctions>().array() == 0).all());
  for (int j = kAffineFunctions + 1; j < space.size(); ++j)
    CHECK(space.weights[j] <= space.weights[j - 1]);
}

TEST_CASE("shape_space: affine images of the rest shape are in it", "[modal]") {
  const Bar bar;
  const ShapeSpace space = bar.space(kAffineFunctions);
  REQUIRE(space.size() == kAffineFunctions);
  Mat3 affine;
  affine << 0, -2, 0, 1, 0.5, 0, 0.1, 0, 1;
  const Positions image = (affine * bar.mesh.rest_positions).colwise() + Vec3(1, 2, 3);
  CHECK(farthest(space.positions(space.coordinates(image)), image) < 1e-12);
  CHECK((space.centroid(space.coordinates(image)) - image * bar.masses / bar.masses.sum()).norm() <
        1e-12);
}

TEST_CASE("shape_space: modes are in it, an added shape exactly, others ever nearer", "[modal]") {
  const Bar bar;
  const ShapeSpace all = bar.space(100);
  for (Eigen::Index m = 0; m < bar.modes.size(); ++m) {
    const Eigen::VectorXd shape = bar.modes.shapes.col(m) / bar.modes.shapes.col(m).norm();
    const Positions moved = bar.mesh.rest_positions + shape.reshaped(3, bar.mesh.n_vertices());
    CAPTURE(m);
    CHECK(farthest(all.positions(all.coordinates(moved)), moved) < 1e-9);
  }
  const Positions arc = bent(bar.mesh.rest_positions, 2);
  const auto off = [&](const ShapeSpace& space) {
    return farthest(space.positions(space.coordinates(arc)), arc);
  };
  CHECK(off(bar.space(20)) < 0.5 * off(bar.space(kAffineFunctions)));
  CHECK(off(bar.space(20)) > 1e-6);
  CHECK(off(bar.space(20, {arc})) < 1e-12);
}

TEST_CASE("shape_space: a flat volume is refused", "[modal]") {
  const Bar bar;
  Positions flat = bar.mesh.rest_positions;
  flat.row(2).setZero();
  CHECK_THROWS_AS(shape_space(flat, bar.masses, {bar.modes}, {}, 10), ContractError);
}

TEST_CASE("shape_clusters: a bar is cut along its length", "[modal]") {
  const Bar bar;
  const std::vector<int> clusters = shape_clusters(bar.mesh, bar.space(20), 8);
  CHECK(clusters == shape_clusters(bar.mesh, bar.space(20), 8));
  CHECK(std::set<int>(clusters.begin(), clusters.end()) == std::set<int>{0, 1, 2, 3, 4, 5, 6, 7});
  // A piece of a bar that bends is short.
  for (int cluster = 0; cluster < 8; ++cluster) {
    double low = 1, high = -1;
    for (std::size_t t = 0; t < clusters.size(); ++t) {
      if (clusters[t] != cluster) continue;
      double x = 0;
      for (const VertexId v : bar.mesh.tets[t]) x += bar.mesh.rest_positions.col(v).x() / 4;
      low = std::min(low, x);
      high = std::max(high, x);
    }
    CAPTURE(cluster, low, high);
    CHECK(high - low < 0.5);
  }
}
