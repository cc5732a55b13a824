#include "core/hierarchy/surface_distances.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "core/base/random.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

std::vector<VertexId> all_vertices(const TriangleMesh& mesh) {
  std::vector<VertexId> all;
  all.reserve(static_cast<std::size_t>(mesh.n_vertices()));
  for (int v = 0; v < mesh.n_vertices(); ++v) all.emplace_back(v);
  return all;
}

std::vector<VertexId> inner_vertices(const TriangleMesh& mesh) {
  std::vector<VertexId> inner = all_vertices(mesh);
  for (const MeshEdge& edge : mesh_edges(mesh.triangles))
    if (edge.is_border()) inner.erase(std::remove(inner.begin(), inner.end(), edge.a), inner.end());
  return inner;
}

/// The surface of the unit cube, `n` x `n` squares a side, with vertices joined at its edges.
TriangleMesh cube() {
  TriangleMesh mesh;
  mesh.rest_positions.resize(3, 8);
  for (int v = 0; v < 8; ++v) mesh.rest_positions.col(v) = Vec3(v & 1, v >> 1 & 1, v >> 2 & 1);
  const std::array<std::array<int, 4>, 6> sides = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : sides) {
    mesh.triangles.push_back({VertexId(a), VertexId(b), VertexId(c)});
    mesh.triangles.push_back({VertexId(a), VertexId(c), VertexId(d)});
  }
  return mesh;
}

}  // namespace

TEST_CASE("surface distances: on a flat sheet they are straight", "[multigrid]") {
  const auto pattern = GENERATE(from_range(kTriangulations));
  CAPTURE(static_cast<int>(pattern));
  const TriangleMesh mesh = triangulated_sheet(pattern, 9, 7, 0.1);
  SurfaceDistances surface(mesh);
  // A straight line between vertices of a moved border may leave the sheet.
  const std::vector<VertexId> ends =
      pattern == Triangulation::jittered ? inner_vertices(mesh) : all_vertices(mesh);
  for (const VertexId start : {ends[0], ends[17], ends[40]}) {
    const std::vector<double> found = surface.to(start, ends);
    for (std::size_t i = 0; i < ends.size(); ++i)
      CHECK(found[i] ==
            Approx((mesh.rest_positions.col(ends[i]) - mesh.rest_positions.col(start)).norm())
                .epsilon(1e-12)
                .margin(1e-15));
  }
}

TEST_CASE("surface distances: along the border of a strip of needles", "[multigrid]") {
  // A ladder of 200 rungs a millimetre apart, each a metre long.
  constexpr int kRungs = 200;
  TriangleMesh ladder;
  ladder.rest_positions.resize(3, 2 * (kRungs + 1));
  for (int r = 0; r <= kRungs; ++r)
    for (int side = 0; side < 2; ++side)
      ladder.rest_positions.col(2 * r + side) = Vec3(side, 1.5 - 1e-3 * r, 0);
  for (int r = 0; r < kRungs; ++r) {
    const VertexId a(2 * r), b(2 * r + 1), c(2 * r + 3), d(2 * r + 2);
    ladder.triangles.push_back({a, d, b});
    ladder.triangles.push_back({b, d, c});
  }
  SurfaceDistances surface(ladder);
  for (int start = 0; start < ladder.n_vertices(); start += 37) {
    const std::vector<double> found = surface.to(VertexId(start), all_vertices(ladder));
    for (int v = 0; v < ladder.n_vertices(); ++v)
      CHECK(found[static_cast<std::size_t>(v)] ==
            Approx((ladder.rest_positions.col(v) - ladder.rest_positions.col(start)).norm()));
  }
}

TEST_CASE("surface distances: a sheet that has a flat pattern is measured there", "[multigrid]") {
  TriangleMesh mesh = triangulated_sheet(Triangulation::one_way, 10, 10, 0.1);
  const Positions lying = mesh.rest_positions;
  mesh.pattern = pattern_of(mesh);
  mesh.rest_positions = on_cylinder(lying, 0.4, 0.25);
  SurfaceDistances surface(mesh);
  const std::vector<double> found = surface.to(VertexId(3), all_vertices(mesh));
  for (int v = 0; v < mesh.n_vertices(); ++v)
    CHECK(found[static_cast<std::size_t>(v)] ==
          Approx((lying.col(v) - lying.col(3)).norm()).epsilon(1e-12).margin(1e-15));
}

TEST_CASE("surface distances: over the sides of a cube", "[multigrid]") {
  SurfaceDistances surface(cube());
  const std::vector<double> found =
      surface.to(VertexId(0), {VertexId(1), VertexId(3), VertexId(7)});
  CHECK(found[0] == Approx(1));
  CHECK(found[1] == Approx(std::sqrt(2)));
  CHECK(found[2] == Approx(std::sqrt(5)));
}

TEST_CASE("surface distances: around a corner cut into a sheet", "[multigrid]") {
  // Squares in an L; the path from end to end turns at the inner corner (2, 2).
  TriangleMesh mesh = triangulated_sheet(Triangulation::alternating, 4, 4, 1);
  std::vector<Triangle> l_shaped;
  for (const Triangle& t : mesh.triangles) {
    Vec3 middle = Vec3::Zero();
    for (const VertexId v : t) middle += mesh.rest_positions.col(v) / 3;
    if (middle.x() < 2 || middle.y() < 2) l_shaped.push_back(t);
  }
  mesh.triangles = l_shaped;
  mesh.warp_directions.clear();
  const auto at = [&](double x, double y) {
    for (int v = 0; v < mesh.n_vertices(); ++v)
      if ((mesh.rest_positions.col(v) - Vec3(x, y, 0)).norm() < 1e-9) return VertexId(v);
    return VertexId();
  };
  SurfaceDistances surface(mesh);
  const std::vector<double> found = surface.to(at(4, 1), {at(1, 4), at(2, 3)});
  CHECK(found[0] == Approx(2 * std::sqrt(5)));
  CHECK(found[1] == Approx(std::sqrt(5) + 1));
}

TEST_CASE("surface distances: a path turns at a saddle", "[multigrid]") {
  // Eight right-angled triangles with a corner each in the middle: two full turns there.
  constexpr int kFans = 8;
  TriangleMesh mesh;
  mesh.rest_positions.resize(3, kFans + 1);
  mesh.rest_positions.col(0).setZero();
  for (int k = 0; k < kFans; ++k) {
    const double angle = 2 * 3.14159265358979323846 * k / kFans;
    mesh.rest_positions.col(k + 1) = Vec3(std::cos(angle), std::sin(angle), k % 2 ? 0.5 : -0.5);
  }
  for (int k = 0; k < kFans; ++k) {
    mesh.triangles.push_back({VertexId(0), VertexId(k + 1), VertexId((k + 1) % kFans + 1)});
    CornerTexture corner;
    corner << 0, 1, 0, 0, 0, 1;
    mesh.pattern.push_back(corner);
  }
  SurfaceDistances surface(mesh);
  const std::vector<double> found =
      surface.to(VertexId(1), {VertexId(2), VertexId(3), VertexId(4), VertexId(5), VertexId(8)});
  CHECK(found[0] == Approx(std::sqrt(2)));
  for (const std::size_t k : {1u, 2u, 3u}) CHECK(found[k] == Approx(2));
  CHECK(found[4] == Approx(std::sqrt(2)));
}

TEST_CASE("surface distances: on a crumpled sheet they are the same there and back",
          "[multigrid]") {
  // Half of its vertices are saddles: a direction that is left out at a turn is missed one way.
  TriangleMesh mesh = triangulated_sheet(Triangulation::jittered, 8, 8, 0.1);
  Random random(3);
  for (Eigen::Index v = 0; v < mesh.rest_positions.cols(); ++v)
    mesh.rest_positions(2, v) = random.uniform(-0.1, 0.1);
  SurfaceDistances surface(mesh);
  const std::vector<VertexId> all = all_vertices(mesh);
  const auto n = static_cast<Eigen::Index>(all.size());
  Eigen::MatrixXd found(n, n);
  for (Eigen::Index start = 0; start < n; ++start)
    found.row(start) = Eigen::Map<const Eigen::RowVectorXd>(
        surface.to(all[static_cast<std::size_t>(start)], all).data(), n);
  CHECK((found - found.transpose()).cwiseAbs().maxCoeff() < 1e-12);
  // No detour by a third vertex is shorter.
  for (Eigen::Index via = 0; via < n; ++via) {
    const Eigen::MatrixXd detours = found.col(via).replicate(1, n) + found.row(via).replicate(n, 1);
    REQUIRE((found - detours).maxCoeff() < 1e-12);
  }
}

TEST_CASE("surface distances: a path goes from one fan of triangles to another", "[multigrid]") {
  // Two squares that share the corner (1, 1) alone.
  TriangleMesh mesh;
  mesh.rest_positions.resize(3, 7);
  mesh.rest_positions << 0, 1, 1, 0, 2, 2, 1, 0, 0, 1, 1, 1, 2, 2, 0, 0, 0, 0, 0, 0, 0;
  const auto add = [&](int a, int b, int c) {
    mesh.triangles.push_back({VertexId(a), VertexId(b), VertexId(c)});
  };
  add(0, 1, 3);
  add(1, 2, 3);
  add(2, 4, 6);
  add(4, 5, 6);
  SurfaceDistances surface(mesh);
  const std::vector<double> found = surface.to(VertexId(0), {VertexId(2), VertexId(5)});
  CHECK(found[0] == Approx(std::sqrt(2)));
  CHECK(found[1] == Approx(2 * std::sqrt(2)));
}

}  // namespace pleat
