#include "core/fabric/curvature_stencil.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/linalg/orthonormal.h"

namespace pleat {
namespace {

using Vec2 = Eigen::Vector2d;
using Places = Eigen::Matrix<double, 2, Eigen::Dynamic>;

/// The triangle beyond each edge of a triangle, edge k running from corner k to corner k + 1;
/// invalid at a border.
using Neighbours = std::vector<std::array<FaceId, 3>>;

std::size_t edge_before(const Triangle& triangle, VertexId across) {
  return triangle[0] == across ? 1 : triangle[1] == across ? 2 : 0;
}

Neighbours neighbours(const TriangleMesh& mesh) {
  Neighbours beside(mesh.triangles.size());
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    if (edge.is_border()) continue;
    for (std::size_t side = 0; side < 2; ++side) {
      const FaceId face = edge.faces[side];
      beside[face][edge_before(mesh.triangles[face], edge.across[side])] = edge.faces[1 - side];
    }
  }
  return beside;
}

/// A triangle and some around it, unfolded into its plane edge by edge with their rest lengths.
class UnfoldedPatch {
 public:
  UnfoldedPatch(const TriangleMesh& mesh, const Neighbours& beside, FaceId centre)
      : mesh_(&mesh), beside_(&beside), faces_{centre}, area_(rest_area(mesh, centre)) {
    const CornerTexture flat = flat_corners(mesh, centre);
    for (std::size_t k = 0; k < 3; ++k)
      place(mesh.triangles[centre][k], flat.col(static_cast<Eigen::Index>(k)));
  }

  /// Adds the triangles beyond the edges of the first one.
  void add_flaps() {
    for (std::size_t k = 0; k < 3; ++k) add_beyond(0, k);
  }

  /// Adds the triangles that share a vertex with those added before, breadth first and not many
  /// more than a fit needs: the cap of a cylinder may be a fan of hundreds.
  void add_ring() {
    constexpr std::size_t kEnough = 60;  // vertices: two rings of six or eight triangles each
    const std::vector<VertexId> core = vertices_;
    const auto touches_core = [&](const Triangle& t) {
      return std::find_first_of(t.begin(), t.end(), core.begin(), core.end()) != t.end();
    };
    for (std::size_t f = 0; f < faces_.size(); ++f) {  // the list grows meanwhile
      for (std::size_t k = 0; k < 3; ++k) {
        if (vertices_.size() >= kEnough) return;
        const FaceId next = (*beside_)[faces_[f]][k];
        if (next.valid() && touches_core(mesh_->triangles[next])) add_beyond(f, k);
      }
    }
  }

  double area() const { return area_; }
  const std::vector<VertexId>& vertices() const { return vertices_; }
  Eigen::Map<const Places> places() const {
    return {places_.front().data(), 2, static_cast<Eigen::Index>(places_.size())};
  }

 private:
  void place(VertexId v, const Vec2& where) {
    vertices_.push_back(v);
    places_.push_back(where);
  }

  /// The vertex's place, or null when it has none yet.
  const Vec2* find(VertexId v) const {
    const auto found = std::find(vertices_.begin(), vertices_.end(), v);
    return found == vertices_.end() ? nullptr : &places_[found - vertices_.begin()];
  }

  void add_beyond(std::size_t index, std::size_t edge) {
    const FaceId next = (*beside_)[faces_[index]][edge];
    if (!next.valid() || std::find(faces_.begin(), faces_.end(), next) != faces_.end()) return;
    faces_.push_back(next);
    const Triangle& t = mesh_->triangles[faces_[index]];
    const VertexId a = t[edge];
    const VertexId b = t[(edge + 1) % 3];
    const Triangle& beyond = mesh_->triangles[next];
    const auto corner =
        std::find_if(beyond.begin(), beyond.end(), [&](VertexId v) { return v != a && v != b; });
    if (find(*corner) != nullptr) return;
    // Wound alike, the triangle beyond goes from b to a and then to its corner.
    const CornerTexture flat = flat_corners(*mesh_, next);
    const Eigen::Index k = corner - beyond.begin();
    const Vec2 at_b = flat.col((k + 1) % 3);
    const Vec2 at_a = flat.col((k + 2) % 3);
    place(*corner, unfolded(a, b, flat.col(k) - at_a, at_b - at_a, *find(t[(edge + 2) % 3])));
  }

  /// The foot of the corner on the edge, as a share of it, and its height above it stay as they are
  /// in its own triangle; the corner goes to the side of the edge where `inside` is not.
  ///
  /// arm, edge  from a to the corner and to b, in the triangle beyond [m]
  Vec2 unfolded(VertexId a, VertexId b, const Vec2& arm, const Vec2& edge,
                const Vec2& inside) const {
    const double foot = arm.dot(edge) / edge.squaredNorm();
    const double height = (arm - foot * edge).norm();
    const Vec2& place_a = *find(a);
    const Vec2 along = *find(b) - place_a;
    const Vec2 left = Vec2(-along.y(), along.x()).normalized();
    const double side = left.dot(inside - place_a) > 0 ? -1 : 1;
    return place_a + foot * along + side * height * left;
  }

  const TriangleMesh* mesh_;
  const Neighbours* beside_;
  std::vector<FaceId> faces_;
  std::vector<VertexId> vertices_;
  std::vector<Vec2> places_;
  double area_;
};

using PerPlace = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// The parts of y1^2/2, y2^2/2 and y1 y2/sqrt(2) that are orthogonal to every affine function, at
/// places of mean 0 and covariance 1: there 1, y1, y2 are orthogonal, each of squared length n.
PerPlace bare_quadratics(const Places& y) {
  const auto n = static_cast<double>(y.cols());
  PerPlace affine(y.cols(), 3);
  affine << Eigen::VectorXd::Ones(y.cols()), y.transpose();
  const auto y1 = affine.col(1).array();
  const auto y2 = affine.col(2).array();
  PerPlace quadratics(y.cols(), 3);
  quadratics << y1.square() / 2, y2.square() / 2, y1 * y2 / std::sqrt(2.0);
  const Mat3 shares = affine.transpose() * quadratics / n;
  return quadratics - affine * shares;
}

/// The map from (H11, H22, sqrt(2) H12) of a symmetric H to the same three of T H T.
Mat3 congruence(const Eigen::Matrix2d& T) {
  const double a = T(0, 0);
  const double b = T(0, 1);
  const double c = T(1, 1);
  const double root2 = std::sqrt(2.0);
  Mat3 S;
  S.row(0) << a * a, b * b, root2 * a * b;
  S.row(1) << b * b, c * c, root2 * b * c;
  S.row(2) << root2 * a * b, root2 * b * c, a * c + b * b;
  return S;
}

/// The quadratic nearest to the values at some places.
struct Fit {
  Eigen::Matrix<double, 3, Eigen::Dynamic> weights;  ///< rows: second derivatives per value
  bool is_determined = false;
};

/// Fitted in the coordinates y = C^(-1/2) (x - mean), C the covariance of the n places: whether six
/// points lie on a conic does not change under such a map, so needles are judged like other
/// triangles. With R the bare quadratics, values f have the coefficients h = (R^T R)^-1 R^T f,
/// which are H11, H22 and sqrt(2) H12; an affine f has none. With T = C^(-1/2) the second
/// derivatives by x are T H T. Of those that the places do not tell apart the smallest are taken
/// (sum of squares of all entries): the least bending that agrees with the values.
Fit fitted(const Eigen::Ref<const Places>& places) {
  constexpr double kNearlyConic = 0.1;   // root mean square of the least visible quadratic; nearer
                                         // to a conic weights, and what they make of higher
                                         // derivatives, grow as its inverse
  constexpr double kNearlyLine = 1e-14;  // ratio of variances; thinner is lost in rounding
  const auto n = static_cast<double>(places.cols());
  const Places centred = places.colwise() - places.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> covariance(centred * centred.transpose() /
                                                                  n);
  if (!(covariance.eigenvalues()[0] > kNearlyLine * covariance.eigenvalues()[1]))
    return {Eigen::Matrix<double, 3, Eigen::Dynamic>::Zero(3, places.cols()), false};
  const Eigen::Matrix2d T = covariance.operatorInverseSqrt();
  const PerPlace R = bare_quadratics(T * centred);

  const Eigen::SelfAdjointEigenSolver<Mat3> gram(R.transpose() * R / n);
  Mat3 seen = gram.eigenvectors();  // columns: coefficients that the places determine
  Mat3 unseen = gram.eigenvectors();
  Vec3 inverse = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const bool is_seen = gram.eigenvalues()[k] > kNearlyConic * kNearlyConic;
    if (is_seen) inverse[k] = 1 / gram.eigenvalues()[k];
    (is_seen ? unseen : seen).col(k).setZero();
  }
  const Mat3 S = congruence(T);
  Fit fit{S * seen * inverse.asDiagonal() * (R * seen).transpose() / n, unseen.isZero(0)};
  if (!fit.is_determined) {
    const Eigen::MatrixXd base = orthonormal_in_order(S * unseen);
    fit.weights -= base * (base.transpose() * fit.weights).eval();
  }
  fit.weights.row(2) /= std::sqrt(2.0);
  return fit;
}

CurvatureStencil stencil(const TriangleMesh& mesh, const Neighbours& beside, FaceId face) {
  UnfoldedPatch patch(mesh, beside, face);
  patch.add_flaps();
  Fit fit = fitted(patch.places());
  if (!fit.is_determined) {
    patch = UnfoldedPatch(mesh, beside, face);
    for (int ring = 0; ring < 2 && !fit.is_determined; ++ring) {
      patch.add_ring();
      fit = fitted(patch.places());
    }
  }
  return {patch.vertices(), std::move(fit.weights), patch.area()};
}

}  // namespace

std::vector<CurvatureStencil> curvature_stencils(const TriangleMesh& mesh) {
  PLEAT_CHECK(mesh.warp_directions.size() == mesh.triangles.size(),
              "each triangle has a warp direction");
  const Neighbours beside = neighbours(mesh);
  std::vector<CurvatureStencil> stencils;
  stencils.reserve(mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    stencils.push_back(stencil(mesh, beside, FaceId(static_cast<std::int64_t>(f))));
  return stencils;
}

}  // namespace pleat
