#include "core/error/mesh_sampling.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

constexpr double kRollRadius = 2;  // [m], around a sheet of 1 m

QuadMesh refined_sheet(int cells, int levels) {
  QuadMesh mesh = lying_sheet(cells);
  mesh.refine_uniformly(levels);
  return mesh;
}

/// Rolled along warp without stretch.
Positions rolled(const QuadMesh& mesh) {
  Positions x = mesh.rest_positions();
  for (Eigen::Index v = 0; v < x.cols(); ++v) {
    const double angle = mesh.rest_coordinates()(0, v) / kRollRadius;
    x.col(v) = Vec3(kRollRadius * std::sin(angle), x(1, v), kRollRadius * std::cos(angle));
  }
  return x;
}

/// Error of a cylinder on chords of a length, known at n + 1 points of each.
SamplingError chord_error(double length, int n) {
  const double sagitta = length * length / (8 * kRollRadius);
  const double turn = length / kRollRadius;
  return {sagitta * std::sqrt(8.0 / 15 * (1 - std::pow(n, -4))),
          turn * std::sqrt((1 - std::pow(n, -2)) / 12)};
}

}  // namespace

TEST_CASE("mesh sampling: a cylinder loses its sagitta and the turn of its chords", "[error]") {
  const int level = GENERATE(0, 1, 2);
  constexpr int kCells = 4;
  constexpr int kFineLevel = 3;
  const QuadMesh fine = refined_sheet(kCells, kFineLevel);
  const MeshSampling sampling(refined_sheet(kCells, level), fine);
  const SamplingError error = sampling.error(rolled(fine));
  const SamplingError known = chord_error(1.0 / (kCells << level), 1 << (kFineLevel - level));
  CHECK(error.distance == Approx(known.distance).epsilon(0.005));  // arcs are no parabolas
  CHECK(error.normal_angle == Approx(known.normal_angle).epsilon(1e-6));
}

TEST_CASE("mesh sampling: what the mesh itself can show loses nothing", "[error]") {
  const QuadMesh fine = refined_sheet(3, 2);
  CHECK(MeshSampling(fine, fine).error(rolled(fine)).distance == 0);
  CHECK(MeshSampling(fine, fine).error(rolled(fine)).normal_angle == 0);
  Positions sheared = fine.rest_positions();
  sheared.row(2) += 0.3 * sheared.row(0) - 0.2 * sheared.row(1);
  for (const int cells : {3, 5}) {
    const SamplingError error = MeshSampling(lying_sheet(cells), fine).error(sheared);
    CHECK(error.distance < 1e-12);
    CHECK(error.normal_angle < 1e-7);
  }
}

TEST_CASE("mesh sampling: meshes of another base are measured alike", "[error]") {
  const QuadMesh fine = refined_sheet(4, 4);
  const MeshSampling same(refined_sheet(4, 1), fine);
  const MeshSampling other(lying_sheet(8), fine);  // has the same vertices
  CHECK(other.error(rolled(fine)).distance ==
        Approx(same.error(rolled(fine)).distance).epsilon(1e-9));
  CHECK(other.error(rolled(fine)).normal_angle ==
        Approx(same.error(rolled(fine)).normal_angle).epsilon(1e-9));
  const MeshSampling uneven(lying_sheet(7), fine);  // its vertices lie between fine ones
  CHECK(uneven.error(rolled(fine)).distance ==
        Approx(chord_error(1.0 / 7, 100).distance).epsilon(0.03));
}

TEST_CASE("mesh sampling: facets that lie across fine triangles are not smoothed", "[error]") {
  const QuadMesh fine = refined_sheet(4, 2);
  const SamplingError uneven = MeshSampling(lying_sheet(7), fine).error(rolled(fine));
  const SamplingError nested = MeshSampling(refined_sheet(4, 1), fine).error(rolled(fine));
  CHECK(uneven.normal_angle > nested.normal_angle);  // seven facets against eight
  CHECK(uneven.normal_angle == Approx(chord_error(1.0 / 7, 100).normal_angle).epsilon(0.05));
}

TEST_CASE("mesh sampling: hanging vertices are drawn in the middle", "[error]") {
  const int cells = GENERATE(4, 5);  // cells of the fine mesh's base, and of another one
  QuadMesh graded = lying_sheet(cells);
  graded.refine(std::array{FaceId(5)});
  REQUIRE(!graded.hanging_vertices().empty());
  const QuadMesh fine = refined_sheet(4, 2);
  const MeshSampling sampling(graded, fine);
  const Positions sampled = sampling.sampled(rolled(fine));
  for (const HangingVertex& h : graded.hanging_vertices())
    CHECK(
        (2 * sampled.col(h.vertex) - sampled.col(h.parents[0]) - sampled.col(h.parents[1])).norm() <
        1e-14);
  CHECK(sampling.error(rolled(fine)).distance <
        MeshSampling(lying_sheet(cells), fine).error(rolled(fine)).distance);
}

}  // namespace pleat
