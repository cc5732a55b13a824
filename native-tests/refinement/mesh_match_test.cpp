#include "core/refinement/mesh_match.h"

#include <catch2/catch.hpp>
#include <set>

#include "core/base/check.h"
#include "core/base/random.h"
#include "native-tests/support/bent_sheets.h"

namespace pleat {
namespace {

QuadMesh randomly_refined(QuadMesh mesh, std::uint64_t seed, int n_splits, int max_level) {
  Random random(seed);
  for (int i = 0; i < n_splits; ++i) {
    const FaceId face(random.below(static_cast<std::int64_t>(mesh.faces().size())));
    if (mesh.faces()[face].level < max_level) mesh.refine(std::array{face});
  }
  return mesh;
}

}  // namespace

TEST_CASE("mesh match: matching vertices are the same points of the cloth", "[refinement]") {
  const int seed = GENERATE(1, 2, 3);
  const QuadMesh mesh = randomly_refined(lying_sheet(5), static_cast<std::uint64_t>(seed), 25, 3);
  QuadMesh fine = lying_sheet(5);
  fine.refine_uniformly(3);
  const std::vector<VertexId> matching = matching_vertices(mesh, fine);
  REQUIRE(matching.size() == static_cast<std::size_t>(mesh.n_vertices()));
  for (int v = 0; v < mesh.n_vertices(); ++v)
    CHECK((mesh.rest_positions().col(v) - fine.rest_positions().col(matching[v])).norm() < 1e-14);
  const std::vector<FaceId> faces = matching_faces(mesh, fine);
  for (std::size_t f = 0; f < faces.size(); ++f)
    CHECK(fine.faces()[faces[f]].level == mesh.faces()[f].level);
}

TEST_CASE("mesh match: a mesh that is not finer is refused", "[refinement]") {
  QuadMesh fine = lying_sheet(3);
  fine.refine_uniformly(1);
  QuadMesh finer = fine;
  finer.refine(std::array{FaceId(9)});
  CHECK_NOTHROW(matching_faces(fine, finer));
  CHECK_THROWS_AS(matching_faces(finer, fine), ContractError);
  CHECK_THROWS_AS(matching_vertices(lying_sheet(3), lying_sheet(4)), ContractError);
}

TEST_CASE("mesh match: affine functions are continued exactly", "[refinement]") {
  const QuadMesh base = lying_sheet(4);
  const QuadMesh mesh = randomly_refined(base, 5, 20, 2);
  QuadMesh fine = base;
  fine.refine_uniformly(2);
  const auto affine = [](const QuadMesh& m) {
    return Eigen::MatrixXd(Eigen::RowVector3d(2, -1, 0) * m.rest_positions());
  };
  CHECK((continued(affine(base), mesh) - affine(mesh)).cwiseAbs().maxCoeff() < 1e-14);
  CHECK((on_finer_mesh(affine(mesh), mesh, fine) - affine(fine)).cwiseAbs().maxCoeff() < 1e-14);
  // Known values are kept to the bit, however they vary.
  Random random(6);
  Eigen::MatrixXd values(1, mesh.n_vertices());
  for (Eigen::Index v = 0; v < values.cols(); ++v) values(0, v) = random.uniform(-1, 1);
  const Eigen::MatrixXd spread = on_finer_mesh(values, mesh, fine);
  const std::vector<VertexId> matching = matching_vertices(mesh, fine);
  for (int v = 0; v < mesh.n_vertices(); ++v) CHECK(spread.col(matching[v])[0] == values(0, v));
}

TEST_CASE("mesh match: a sample has hanging vertices in the middle, others in place",
          "[refinement]") {
  const QuadMesh mesh = randomly_refined(lying_sheet(8), 7, 20, 2);
  QuadMesh fine = lying_sheet(8);
  fine.refine_uniformly(2);
  const Positions x = folded(fine, 0.4, 1.0);
  const Positions sample = MeshSample(mesh, fine).of(x);
  const std::vector<VertexId> matching = matching_vertices(mesh, fine);
  std::set<int> hanging;
  for (const HangingVertex& h : mesh.hanging_vertices()) {
    hanging.insert(h.vertex);
    CHECK(2 * sample.col(h.vertex) == sample.col(h.parents[0]) + sample.col(h.parents[1]));
  }
  REQUIRE(!hanging.empty());
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (hanging.count(v) == 0) CHECK(sample.col(v) == x.col(matching[v]));
}

TEST_CASE("mesh match: a fingerprint tells base meshes apart, not their refinements",
          "[refinement]") {
  const QuadMesh base = lying_sheet(6);
  CHECK(base_fingerprint(randomly_refined(base, 3, 10, 3)) == base_fingerprint(base));
  CHECK(base_fingerprint(lying_sheet(7)) != base_fingerprint(base));
  const auto sheet = [](double width, double x) {
    SheetShape shape;
    shape.rows = shape.columns = 6;
    shape.warp_direction = {1, 0, 0};
    shape.weft_direction = {0, 1, 0};
    shape.width = width;
    shape.origin = {x, 0, 0};
    return base_fingerprint(QuadMesh::sheet(shape));
  };
  CHECK(sheet(1, 0) == base_fingerprint(base));
  CHECK(sheet(1, 1e-12) == base_fingerprint(base));
  CHECK(sheet(1.0001, 0) != base_fingerprint(base));
}

}  // namespace pleat
