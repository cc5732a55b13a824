#include "core/refinement/face_losses.h"

#include <array>

#include "core/base/check.h"

namespace pleat {
namespace {

/// Vertices along each side of a face whose grid has so many.
int side_of(std::size_t n_vertices) {
  int side = 2;
  while (static_cast<std::size_t>(side * side) < n_vertices) side = 2 * side - 1;
  return side;
}

/// The vertices of the finest faces that each face covers. Corners 0, 1, 2, 3 of a face are at
/// (0, 0), (1, 0), (1, 1), (0, 1) of its parameters; its children's are oriented like its own.
std::vector<std::vector<VertexId>> covered_grids(const QuadMesh& fine) {
  std::vector<std::vector<VertexId>> grids(fine.faces().size());
  for (std::size_t f = grids.size(); f-- > 0;) {  // children come after their parent
    const QuadFace& face = fine.faces()[f];
    std::vector<VertexId>& grid = grids[f];
    if (face.active()) {
      grid = {face.corners[0], face.corners[1], face.corners[3], face.corners[2]};
      continue;
    }
    const int part = side_of(grids[face.children[0]].size());
    const int side = 2 * part - 1;
    grid.resize(static_cast<std::size_t>(side * side));
    for (int k = 0; k < 4; ++k) {
      const std::vector<VertexId>& own = grids[face.children[k]];
      const int first = (k >= 2 ? part - 1 : 0) * side + (k == 1 || k == 2 ? part - 1 : 0);
      for (int row = 0; row < part; ++row)
        std::copy_n(own.begin() + row * part, part, grid.begin() + first + row * side);
    }
  }
  return grids;
}

}  // namespace

FaceLossSum::FaceLossSum(const QuadMesh& fine)
    : fine_(fine),
      grids_(covered_grids(fine)),
      sums_(FaceLosses::Zero(4, static_cast<Eigen::Index>(fine.faces().size()))) {}

// With e the shape minus the patch of corners that are where the shape is, d the way from the
// middle of the edge to the corner that hangs there, and h that corner's bilinear hat, the drawn
// patch is d h behind: the error becomes e + d h. Its mean square needs the means of e^2, h e and
// h^2 alone. By the trapezoid rule a vertex counts with the parts of the cells around it.
void FaceLossSum::add(const PositionsView& positions) {
  PLEAT_CHECK(positions.cols() == fine_.n_vertices(), "one position per vertex");
  ++n_frames_;
  for (std::size_t f = 0; f < grids_.size(); ++f) {
    const QuadFace& face = fine_.faces()[f];
    const std::vector<VertexId>& grid = grids_[f];
    const int n = side_of(grid.size()) - 1;
    int own = 0;  // number among its parent's children
    std::array<Vec3, 2> shifts{Vec3::Zero(), Vec3::Zero()};
    if (face.parent.valid()) {
      const QuadFace& parent = fine_.faces()[face.parent];
      while (parent.children[own].value != static_cast<std::int32_t>(f)) ++own;
      const Vec3 at_own = positions.col(face.corners[own]);
      for (int hanging = 0; hanging < 2; ++hanging) {
        const int corner = (own + 1 + 2 * hanging) % 4;
        shifts[hanging] = positions.col(face.corners[corner]) -
                          (at_own + positions.col(parent.corners[corner])) / 2;
      }
    }
    double squares = 0;
    double hat_squares = 0;   // sum for either corner
    double hat_products = 0;  // sum for both corners
    std::array<Vec3, 2> pulls{Vec3::Zero(), Vec3::Zero()};
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        const double u = static_cast<double>(i) / n;
        const double v = static_cast<double>(j) / n;
        const std::array<double, 4> hats{(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
        Vec3 error = positions.col(grid[static_cast<std::size_t>(j * (n + 1) + i)]);
        for (int k = 0; k < 4; ++k) error -= hats[k] * positions.col(face.corners[k]);
        const double weight = (i % n == 0 ? 0.5 : 1.0) * (j % n == 0 ? 0.5 : 1.0) / (n * n);
        const double a = hats[(own + 1) % 4];
        const double b = hats[(own + 3) % 4];
        squares += weight * error.squaredNorm();
        pulls[0] += weight * a * error;
        pulls[1] += weight * b * error;
        hat_squares += weight * a * a;
        hat_products += weight * a * b;
      }
    }
    const double area = fine_.area(FaceId(static_cast<std::int64_t>(f)));
    for (int row = 0; row < 4; ++row) {
      const std::array<double, 2> hangs{static_cast<double>(row % 2), static_cast<double>(row / 2)};
      double loss = squares + 2 * hangs[0] * hangs[1] * hat_products * shifts[0].dot(shifts[1]);
      for (int k = 0; k < 2; ++k)
        loss += hangs[k] * shifts[k].dot(2 * pulls[k] + hat_squares * shifts[k]);
      sums_(row, static_cast<Eigen::Index>(f)) += area * loss;
    }
  }
}

}  // namespace pleat
