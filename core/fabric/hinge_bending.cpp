#include "core/fabric/hinge_bending.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/base/check.h"

namespace pleat {
namespace {

using Mat3x9 = Eigen::Matrix<double, 3, 9>;
using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat12 = Eigen::Matrix<double, 12, 12>;

/// A triangle seen from its edge x0 x1: edge e, arm c from x0 to the corner, normal n = e x c.
struct Flap {
  Vec3 edge, arm, normal;

  /// Rounding leaves about 1e-16 of |e| |c| in the normal of three places on a line.
  bool has_area() const {
    constexpr double kNoArea = 1e-12;  // sine at x0; below it the normal is noise
    return normal.norm() > kNoArea * edge.norm() * arm.norm();
  }
};

Flap flap(const Vec3& x0, const Vec3& x1, const Vec3& corner) {
  const Vec3 edge = x1 - x0;
  const Vec3 arm = corner - x0;
  return {edge, arm, edge.cross(arm)};
}

/// How a flap's plane turns about the edge. A move of the corner by d turns it by q.d, with q =
/// |e| n/|n|^2 (unit normal over height); at the corner's foot x0 + t e the edge moving by d turns
/// it back as much, which its ends share by 1 - t and t.
struct Turning {
  Vec3 q;
  double t;
};

Turning turning(const Flap& f) {
  return {f.edge.norm() / f.normal.squaredNorm() * f.normal,
          f.edge.dot(f.arm) / f.edge.squaredNorm()};
}

Mat3 cross_matrix(const Vec3& a) {
  Mat3 A;
  A << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return A;
}

/// Derivatives of (-(1 - t) q, -t q, q) by x0, x1 and the corner, from
///
///     dn = -c x de + e x dc,     d|e| = e.de/|e|,     dt = (e.dc + c.de - 2 t e.de)/|e|^2,
///     dq = n d|e|/|n|^2 + |e|/|n|^2 (I - 2 n n^T/|n|^2) dn,
///
/// where de = dx1 - dx0, dc = dcorner - dx0. One flap's alone is not symmetric; the sum of both is.
Mat9 turning_derivative(const Flap& f) {
  const Vec3& e = f.edge;
  const double length = e.norm();
  const double square = f.normal.squaredNorm();
  const Vec3 unit = f.normal / std::sqrt(square);
  const Turning at = turning(f);
  Mat3x9 dn;
  dn << cross_matrix(f.arm - e), -cross_matrix(f.arm), cross_matrix(e);
  Eigen::Matrix<double, 1, 9> dlength;
  dlength << -e.transpose() / length, e.transpose() / length, Eigen::RowVector3d::Zero();
  const Vec3 by_edge = (f.arm - 2 * at.t * e) / (length * length);
  const Vec3 by_arm = e / (length * length);
  Eigen::Matrix<double, 1, 9> dt;
  dt << -(by_edge + by_arm).transpose(), by_edge.transpose(), by_arm.transpose();
  const Mat3 turned = length / square * (Mat3::Identity() - 2 * unit * unit.transpose());
  const Mat3x9 dq = f.normal / square * dlength + turned * dn;
  Mat9 derivative;
  derivative << (at.t - 1) * dq + at.q * dt, -at.t * dq - at.q * dt, dq;
  return derivative;
}

/// The angle and its gradient by the four vertices. At the second corner the normal e x c points to
/// the other side of the flat sheet, hence the signs.
struct Fold {
  std::array<Flap, 2> flaps;
  bool has_area;

  double angle() const {
    const auto& [one, other] = flaps;
    return std::atan2(one.edge.dot(one.normal.cross(other.normal)),
                      -one.edge.norm() * one.normal.dot(other.normal));
  }

  Vec12 gradient() const {
    const Turning one = turning(flaps[0]);
    const Turning other = turning(flaps[1]);
    Vec12 sum;
    sum << (one.t - 1) * one.q - (other.t - 1) * other.q, -one.t * one.q + other.t * other.q, one.q,
        -other.q;
    return sum;
  }

  Mat12 second_derivative() const {
    Mat12 sum = Mat12::Zero();
    sum.topLeftCorner<9, 9>() = turning_derivative(flaps[0]);
    const Mat9 other = turning_derivative(flaps[1]);
    constexpr std::array<int, 3> kPlaces = {0, 3, 9};  // its corner comes last
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        sum.block<3, 3>(kPlaces[i], kPlaces[j]) -= other.block<3, 3>(3 * i, 3 * j);
    return (sum + sum.transpose()) / 2;  // evens out what rounding left unlike
  }
};

Fold fold(const std::array<VertexId, 4>& vertices, const PositionsView& positions) {
  const Vec3 x0 = positions.col(vertices[0]);
  const Vec3 x1 = positions.col(vertices[1]);
  Fold at{{flap(x0, x1, positions.col(vertices[2])), flap(x0, x1, positions.col(vertices[3]))},
          false};
  at.has_area = at.flaps[0].has_area() && at.flaps[1].has_area();
  return at;
}

}  // namespace

HingeTurn hinge_turn(const std::array<VertexId, 4>& vertices, const PositionsView& positions) {
  HingeTurn turn;
  const Fold at = fold(vertices, positions);
  if (!at.has_area) return turn;
  turn.angle = at.angle();
  turn.gradient.reshaped() = at.gradient();
  return turn;
}

std::vector<Hinge> hinges(const TriangleMesh& mesh, double rigidity) {
  PLEAT_CHECK(rigidity >= 0, "a rigidity is not negative");
  std::vector<Hinge> result;
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    if (edge.is_border()) continue;
    const std::array<VertexId, 4> vertices{edge.a, edge.b, edge.across[0], edge.across[1]};
    PLEAT_CHECK(fold(vertices, mesh.rest_positions).has_area, "each triangle has area at rest");
    const double length = rest_length(mesh, edge);
    const double areas = rest_area(mesh, edge.faces[0]) + rest_area(mesh, edge.faces[1]);
    result.push_back({vertices, rigidity * length * length / areas});
  }
  return result;
}

double hinge_energy(std::span<const Hinge> hinges, const PositionsView& positions) {
  double energy = 0;
  for (const Hinge& hinge : hinges) {
    const Fold at = fold(hinge.vertices, positions);
    if (at.has_area) energy += 0.5 * hinge.stiffness * at.angle() * at.angle();
  }
  return energy;
}

void add_hinge_forces(std::span<const Hinge> hinges, const PositionsView& positions,
                      PositionsRef forces) {
  for (const Hinge& hinge : hinges) {
    const Fold at = fold(hinge.vertices, positions);
    if (!at.has_area) continue;
    const Vec12 pull = hinge.stiffness * at.angle() * at.gradient();
    for (int k = 0; k < 4; ++k) forces.col(hinge.vertices[k]) -= pull.segment<3>(3 * k);
  }
}

Mat12 hinge_stiffness(const Hinge& hinge, const PositionsView& positions, ElementHessian hessian) {
  const Fold at = fold(hinge.vertices, positions);
  if (!at.has_area) return Mat12::Zero();
  const Vec12 gradient = at.gradient();
  Mat12 exact =
      hinge.stiffness * (gradient * gradient.transpose() + at.angle() * at.second_derivative());
  if (hessian == ElementHessian::exact) return exact;
  const Eigen::SelfAdjointEigenSolver<Mat12> modes(exact);
  return modes.eigenvectors() * modes.eigenvalues().cwiseMax(0).asDiagonal() *
         modes.eigenvectors().transpose();
}

}  // namespace pleat
