#include "core/run/carry_over.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/check.h"
#include "core/model/hanging_vertices.h"

namespace pleat {
namespace {

/// Components along uu, vv and uv: of membrane resultants [N/m], or of strains with the engineering
/// shear.
using Membrane = Eigen::Vector3d;

/// One column per vertex.
using Resultants = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Strain of a spring = projection . strain of the sheet, from its direction in the rest
/// coordinates.
Membrane projection(const Spring& spring, const RestCoordinates& uv) {
  const Eigen::Vector2d d = (uv.col(spring.a) - uv.col(spring.b)).normalized();
  return {d.x() * d.x(), d.y() * d.y(), d.x() * d.y()};
}

/// The resultants without negative principal values, since cloth holds no compression but folds,
/// and scaled so that the largest one is at most `largest` [N/m].
Membrane tensile_part(const Membrane& resultants, double largest) {
  const double mean = (resultants[0] + resultants[1]) / 2;
  const double half = (resultants[0] - resultants[1]) / 2;
  const double radius = std::hypot(half, resultants[2]);
  const double major = mean + radius;
  if (major <= 0) return Membrane::Zero();
  const double scale = std::min(1.0, largest / major);
  if (mean >= radius) return scale * resultants;
  // The rest is major n n, with n at half the angle of (half, uv).
  const double cosine = half / radius;
  return scale * major / 2 * Membrane(1 + cosine, 1 - cosine, resultants[2] / radius);
}

/// The most that the whole sheet's weight and swing can ask for: areal density (g l + v^2), with
/// its rest diagonal l and largest speed v [N/m]. Stretch beyond that is what a stepper has not
/// worked off yet, and no force: in a softer fabric it would be a catapult.
double largest_resultant(const MovingSheet& sheet, double area) {
  const RestCoordinates& uv = sheet.mesh.rest_coordinates();
  const double diagonal = (uv.rowwise().maxCoeff() - uv.rowwise().minCoeff()).norm();
  const double speed_squared = sheet.state.velocities.colwise().squaredNorm().maxCoeff();
  return sheet.model.masses.sum() / area * (sheet.model.gravity.norm() * diagonal + speed_squared);
}

/// Membrane resultants around each vertex: (1/A) sum of 1/2 T L d d over the springs that end
/// there, T their tension and d their direction; the tensile part.
Resultants vertex_resultants(const MovingSheet& sheet) {
  const Positions& x = sheet.state.positions;
  Resultants sums = Resultants::Zero(3, x.cols());
  for (const Spring& spring : sheet.model.springs) {
    const double length = (x.col(spring.a) - x.col(spring.b)).norm();
    const double tension = spring.stiffness * (length - spring.rest_length);
    const Membrane share =
        0.5 * tension * spring.rest_length * projection(spring, sheet.model.rest_coordinates);
    sums.col(spring.a) += share;
    sums.col(spring.b) += share;
  }
  pull_to_parents(sheet.model.hanging, sums);
  const Eigen::VectorXd areas = sheet.mesh.vertex_areas();
  const double largest = largest_resultant(sheet, areas.sum());
  for (Eigen::Index i = 0; i < sums.cols(); ++i)
    if (areas[i] > 0) sums.col(i) = tensile_part(sums.col(i) / areas[i], largest);
  place_between_parents(sheet.model.hanging, sums);
  return sums;
}

/// Resultants per strain: (1/A) sum of k L^2 p p over all springs, p their projections [N/m].
Mat3 membrane_stiffness(const MovingSheet& sheet) {
  Mat3 sum = Mat3::Zero();
  for (const Spring& spring : sheet.model.springs) {
    const Membrane p = projection(spring, sheet.model.rest_coordinates);
    sum += spring.stiffness * spring.rest_length * spring.rest_length * p * p.transpose();
  }
  return sum / sheet.mesh.vertex_areas().sum();
}

/// Mesh lines of one refinement level: the vertices before and after each along warp and weft.
class MeshLines {
 public:
  MeshLines(const QuadMesh& mesh, int level)
      : neighbours_(static_cast<std::size_t>(mesh.n_vertices())) {
    for (const QuadFace& face : mesh.faces()) {
      if (face.level != level) continue;
      const auto& c = face.corners;
      join(c[0], c[1], kWarp);
      join(c[3], c[2], kWarp);
      join(c[0], c[3], kWeft);
      join(c[1], c[2], kWeft);
    }
  }

  enum Thread { kWarp = 0, kWeft = 2 };
  VertexId before(VertexId v, Thread thread) const { return neighbours_[v][thread]; }
  VertexId after(VertexId v, Thread thread) const { return neighbours_[v][thread + 1]; }

 private:
  void join(VertexId from, VertexId to, Thread thread) {
    neighbours_[from][thread + 1] = to;
    neighbours_[to][thread] = from;
  }

  std::vector<std::array<VertexId, 4>> neighbours_;  // warp before, after, weft before, after
};

/// Fills the middle of the edge from a to b by the cubic through four vertices of the mesh line,
/// or the parabola through three at its end; straight when there are but two.
void fill_middle(const MeshLines& lines, MeshLines::Thread thread, VertexId a, VertexId b,
                 VertexId middle, Positions& columns) {
  const VertexId before = lines.before(a, thread);
  const VertexId after = lines.after(b, thread);
  const Vec3 at_a = columns.col(a);
  const Vec3 at_b = columns.col(b);
  if (before.valid() && after.valid())
    columns.col(middle) = (9 * (at_a + at_b) - columns.col(before) - columns.col(after)) / 16;
  else if (after.valid())
    columns.col(middle) = (3 * at_a + 6 * at_b - columns.col(after)) / 8;
  else if (before.valid())
    columns.col(middle) = (6 * at_a + 3 * at_b - columns.col(before)) / 8;
  else
    columns.col(middle) = (at_a + at_b) / 2;
}

/// Fills the vertices that split a face, as far as they are new: edge middles along their mesh
/// lines, the centre as Coons' patch between them.
void fill_face(const QuadMesh& mesh, const QuadFace& face, const MeshLines& lines,
               Eigen::Index n_shared, Positions& columns) {
  const auto& c = face.corners;
  const auto& first = mesh.faces()[static_cast<std::size_t>(face.children[0].value)].corners;
  const auto& third = mesh.faces()[static_cast<std::size_t>(face.children[2].value)].corners;
  const VertexId m01 = first[1];
  const VertexId centre = first[2];
  const VertexId m30 = first[3];
  const VertexId m12 = third[1];
  const VertexId m23 = third[3];
  if (centre < n_shared) return;
  fill_middle(lines, MeshLines::kWarp, c[0], c[1], m01, columns);
  fill_middle(lines, MeshLines::kWarp, c[3], c[2], m23, columns);
  fill_middle(lines, MeshLines::kWeft, c[0], c[3], m30, columns);
  fill_middle(lines, MeshLines::kWeft, c[1], c[2], m12, columns);
  columns.col(centre) =
      (columns.col(m01) + columns.col(m12) + columns.col(m23) + columns.col(m30)) / 2 -
      (columns.col(c[0]) + columns.col(c[1]) + columns.col(c[2]) + columns.col(c[3])) / 4;
}

/// Copies the columns that both meshes share; the others are means of their parents, which come
/// earlier, so that no new extremes appear.
Resultants carried_means(const Resultants& old, const QuadMesh& mesh) {
  Resultants fresh(3, mesh.n_vertices());
  const Eigen::Index n_shared = std::min(old.cols(), fresh.cols());
  fresh.leftCols(n_shared) = old.leftCols(n_shared);
  for (Eigen::Index i = n_shared; i < fresh.cols(); ++i) {
    const VertexParents& parents = mesh.parents()[static_cast<std::size_t>(i)];
    fresh.col(i).setZero();
    for (int k = 0; k < parents.count; ++k) fresh.col(i) += fresh.col(parents.vertices[k]);
    fresh.col(i) /= parents.count;
  }
  return fresh;
}

bool join_the_same(const std::vector<Spring>& springs, const std::vector<Spring>& others) {
  return std::equal(springs.begin(), springs.end(), others.begin(), others.end(),
                    [](const Spring& p, const Spring& q) { return p.a == q.a && p.b == q.b; });
}

/// Least strain per resultant: without shear springs nothing answers a shear.
Mat3 strain_per_resultant(const MovingSheet& sheet) {
  return membrane_stiffness(sheet).completeOrthogonalDecomposition().pseudoInverse();
}

/// First stretch of each new spring [m] on the same mesh: by its own tension, compression included.
/// A sheet softer per mass would be stretched further: at most by the largest resultant both ways.
std::vector<double> same_stretches(const MovingSheet& old, const MovingSheet& fresh) {
  const double ratio = mass_ratio(old, fresh);
  const double largest = ratio * largest_resultant(old, old.mesh.vertex_areas().sum());
  const Membrane largest_strain = strain_per_resultant(fresh) * Membrane(largest, largest, 0);
  std::vector<double> stretches;
  for (std::size_t s = 0; s < fresh.model.springs.size(); ++s) {
    const Spring& from = old.model.springs[s];
    const Spring& to = fresh.model.springs[s];
    const double length =
        (old.state.positions.col(from.a) - old.state.positions.col(from.b)).norm();
    // A spring that does not pull may have any rest length.
    const double softness = to.stiffness > 0 ? ratio * from.stiffness / to.stiffness : 0;
    const double stretch = softness * (length - from.rest_length);
    const double limit =
        to.rest_length * std::abs(projection(to, fresh.model.rest_coordinates).dot(largest_strain));
    stretches.push_back(softness <= 1 ? stretch : std::clamp(stretch, -limit, limit));
  }
  return stretches;
}

/// First stretch of each spring on another mesh [m]: by the tensile resultants at both ends.
std::vector<double> smoothed_stretches(const MovingSheet& old, const MovingSheet& fresh) {
  const double ratio = mass_ratio(old, fresh);
  const Resultants resultants = carried_means(vertex_resultants(old), fresh.mesh);
  const Mat3 strains = strain_per_resultant(fresh);
  std::vector<double> stretches;
  for (const Spring& spring : fresh.model.springs) {
    const Membrane mean = 0.5 * (resultants.col(spring.a) + resultants.col(spring.b));
    const double strain =
        ratio * projection(spring, fresh.model.rest_coordinates).dot(strains * mean);
    stretches.push_back(strain * spring.rest_length);
  }
  return stretches;
}

}  // namespace

double mass_ratio(const MovingSheet& old, const MovingSheet& fresh) {
  return fresh.model.masses.sum() / old.model.masses.sum();
}

Positions carried_positions(const Positions& old, const QuadMesh& mesh) {
  Positions fresh(3, mesh.n_vertices());
  const Eigen::Index n_shared = std::min(old.cols(), fresh.cols());
  fresh.leftCols(n_shared) = old.leftCols(n_shared);
  int finest = 0;
  for (const QuadFace& face : mesh.faces()) finest = std::max(finest, face.level);
  for (int level = 0; level < finest; ++level) {
    const MeshLines lines(mesh, level);
    for (const QuadFace& face : mesh.faces())
      if (face.level == level && !face.active()) fill_face(mesh, face, lines, n_shared, fresh);
  }
  return fresh;
}

State carried_state(const MovingSheet& old, const QuadMesh& mesh) {
  State state{carried_positions(old.state.positions, mesh),
              carried_positions(old.state.velocities, mesh)};
  place_between_parents(mesh.hanging_vertices(), state);
  return state;
}

std::vector<double> carried_rest_lengths(const MovingSheet& old, const MovingSheet& fresh) {
  std::vector<double> rest_lengths = join_the_same(old.model.springs, fresh.model.springs)
                                         ? same_stretches(old, fresh)
                                         : smoothed_stretches(old, fresh);
  for (std::size_t s = 0; s < rest_lengths.size(); ++s) {
    const Spring& spring = fresh.model.springs[s];
    const double length =
        (fresh.state.positions.col(spring.a) - fresh.state.positions.col(spring.b)).norm();
    rest_lengths[s] = std::max(0.0, length - rest_lengths[s]);
  }
  return rest_lengths;
}

Positions carried_forces(const Positions& forces, const MovingSheet& old,
                         const MovingSheet& fresh) {
  if (forces.cols() == 0) return Positions::Zero(3, fresh.mesh.n_vertices());
  Positions accelerations = forces;
  for (Eigen::Index i = 0; i < forces.cols(); ++i)
    if (!old.model.hangs(VertexId(i))) accelerations.col(i) *= 1 / old.model.masses[i];
  place_between_parents(old.model.hanging, accelerations);
  return carried_means(accelerations, fresh.mesh) * fresh.model.masses.asDiagonal();
}

}  // namespace pleat
