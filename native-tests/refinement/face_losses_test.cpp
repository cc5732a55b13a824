#include "core/refinement/face_losses.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/random.h"
#include "core/refinement/mesh_match.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

QuadMesh lying_fine_sheet(int cells, int levels) {
  QuadMesh fine = lying_sheet(cells);
  fine.refine_uniformly(levels);
  return fine;
}

/// Sum of the losses of a mesh that the fine one refines, face by face.
double summed(const QuadMesh& mesh, const QuadMesh& fine, const FaceLosses& losses) {
  const std::vector<FaceId> matching = matching_faces(mesh, fine);
  std::vector<bool> hangs(static_cast<std::size_t>(mesh.n_vertices()), false);
  for (const HangingVertex& h : mesh.hanging_vertices()) hangs[h.vertex] = true;
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
    const QuadFace& face = mesh.faces()[f];
    if (!face.active()) continue;
    int row = 0;
    if (face.parent.valid()) {
      const auto& siblings = mesh.faces()[face.parent].children;
      const auto k =
          std::find(siblings.begin(), siblings.end(), FaceId(static_cast<std::int64_t>(f))) -
          siblings.begin();
      row = int{hangs[face.corners[(k + 1) % 4]]} + 2 * int{hangs[face.corners[(k + 3) % 4]]};
    }
    sum += losses(row, matching[f].value);
  }
  return sum;
}

}  // namespace

TEST_CASE("face losses: a plane, however stretched, loses nothing", "[refinement]") {
  const QuadMesh fine = lying_fine_sheet(3, 2);
  Mat3 slanted;
  slanted << 1.1, 0.2, 0, -0.3, 0.8, 0.1, 0.5, 0.4, 1;
  FaceLossSum sum(fine);
  sum.add(slanted * fine.rest_positions());
  CHECK(sum.losses().cwiseAbs().maxCoeff() < 1e-30);
}

TEST_CASE("face losses: a parabola loses its sagitta", "[refinement]") {
  // z = K x^2 / 2 is K u (h - u) / 2 above a chord of length h. At the n + 1 equidistant points of
  // a face, ends halved, the mean square is (K h^2 / 8)^2 (8/15) (1 - 1/n^4).
  constexpr double kCurvature = 3;
  constexpr int kLevels = 3;
  const QuadMesh fine = lying_fine_sheet(2, kLevels);
  Positions x = fine.rest_positions();
  const Eigen::RowVectorXd u = fine.rest_coordinates().row(0);
  x.row(2) = kCurvature / 2 * u.array().square();
  FaceLossSum sum(fine);
  sum.add(x);
  sum.add(x);  // it is a mean over frames
  const FaceLosses losses = sum.losses();
  for (std::size_t f = 0; f < fine.faces().size(); ++f) {
    const int level = fine.faces()[f].level;
    const double h = 0.5 / std::pow(2, level);
    const double n = std::pow(2, kLevels - level);
    const double sagitta = kCurvature * h * h / 8;
    const double mean = sagitta * sagitta * 8 / 15 * (1 - std::pow(n, -4));
    CHECK(losses(0, static_cast<Eigen::Index>(f)) == Approx(h * h * mean).margin(1e-20));
  }
}

TEST_CASE("face losses: those of a graded mesh are what its drawn faces lose", "[refinement]") {
  const int seed = GENERATE(range(1, 9));
  CAPTURE(seed);
  Random random(static_cast<std::uint64_t>(seed));
  const QuadMesh fine = lying_fine_sheet(3, 3);
  QuadMesh mesh = lying_sheet(3);
  for (int split = 0; split < 7; ++split) {
    const FaceId face(random.below(static_cast<std::int64_t>(mesh.faces().size())));
    if (mesh.faces()[face].level < 3) mesh.refine(std::array{face});
  }
  REQUIRE(!mesh.hanging_vertices().empty());
  Positions x = fine.rest_positions();
  for (double& coordinate : x.reshaped()) coordinate += random.uniform(-0.01, 0.01);
  FaceLossSum sum(fine);
  sum.add(x);
  const Positions drawn = on_finer_mesh(MeshSample(mesh, fine).of(x), mesh, fine);
  const double lost = (drawn - x).colwise().squaredNorm().dot(fine.vertex_areas());
  CHECK(summed(mesh, fine, sum.losses()) == Approx(lost).epsilon(1e-12));
}

}  // namespace pleat
