#include "core/error/mesh_sampling.h"

#include <cmath>

#include "core/base/check.h"
#include "core/error/error_norms.h"

namespace pleat {
namespace {

/// True when all splits of the mesh were made in the fine one too.
bool refines(const QuadMesh& fine, const QuadMesh& mesh) {
  if (base_fingerprint(fine) != base_fingerprint(mesh)) return false;
  int coarsest = kMaxLevel;
  int finest = 0;
  for (const QuadFace& face : fine.faces())
    if (face.active()) coarsest = std::min(coarsest, face.level);
  for (const QuadFace& face : mesh.faces()) finest = std::max(finest, face.level);
  return finest <= coarsest;
}

std::size_t n_active(const QuadMesh& mesh) {
  std::size_t n = 0;
  for (const QuadFace& face : mesh.faces()) n += face.active() ? 1 : 0;
  return n;
}

/// Bilinear patches are flat enough to be cut into triangles once cells are as small as the others.
QuadMesh cut_like(QuadMesh mesh, const QuadMesh& fine) {
  while (n_active(mesh) < n_active(fine)) mesh.refine_uniformly(1);
  return mesh;
}

Positions middles(const std::vector<Triangle>& triangles, const Positions& x) {
  Positions middle(3, static_cast<Eigen::Index>(triangles.size()));
  Eigen::Index column = 0;
  for (const Triangle& t : triangles)
    middle.col(column++) = (x.col(t[0]) + x.col(t[1]) + x.col(t[2])) / 3;
  return middle;
}

/// Not of unit length [m^2].
Vec3 normal(const Triangle& t, const PositionsView& x) {
  return Vec3(x.col(t[1]) - x.col(t[0])).cross(Vec3(x.col(t[2]) - x.col(t[0])));
}

Positions normals(const std::vector<Triangle>& triangles, const PositionsView& x) {
  Positions all(3, static_cast<Eigen::Index>(triangles.size()));
  Eigen::Index column = 0;
  for (const Triangle& t : triangles) all.col(column++) = normal(t, x);
  return all;
}

}  // namespace

MeshSampling::MeshSampling(const QuadMesh& mesh, const QuadMesh& fine)
    : mesh_(mesh),
      fine_(fine),
      areas_(fine.vertex_areas()),
      triangles_(fine.triangles()),
      hanging_(mesh.hanging_vertices()),
      cut_(mesh) {
  if (refines(fine, mesh)) {
    sample_.emplace(mesh, fine);
    return;
  }
  to_mesh_.emplace(fine.triangle_mesh(), mesh.rest_positions());
  cut_ = cut_like(mesh, fine);
  to_fine_.emplace(cut_.triangle_mesh(), fine.rest_positions());
  to_facets_.emplace(cut_.triangle_mesh(), middles(triangles_, fine.rest_positions()));
}

Positions MeshSampling::sampled(const PositionsView& fine_columns) const {
  PLEAT_CHECK(fine_columns.cols() == fine_.n_vertices(), "one column per vertex");
  if (sample_) return sample_->of(fine_columns);
  Positions columns = to_mesh_->of(fine_columns);
  straighten(hanging_, columns);
  return columns;
}

Positions MeshSampling::shown(const PositionsView& columns) const {
  if (sample_) return on_finer_mesh(columns, mesh_, fine_);
  return to_fine_->of(on_finer_mesh(columns, mesh_, cut_));
}

SamplingError MeshSampling::error(const PositionsView& fine_positions,
                                  const PositionsView& columns) const {
  const Positions shown_positions = shown(columns);
  const Positions facets = to_facets_ ? to_facets_->normals_of(on_finer_mesh(columns, mesh_, cut_))
                                      : normals(triangles_, shown_positions);
  double squares = 0;
  double area = 0;
  Eigen::Index column = 0;
  for (const Triangle& t : triangles_) {
    const double weight = normal(t, fine_.rest_positions()).norm();
    const Vec3 own = normal(t, fine_positions);
    const Vec3 theirs = facets.col(column++);
    const double angle = std::atan2(own.cross(theirs).norm(), own.dot(theirs));
    squares += weight * angle * angle;
    area += weight;
  }
  return {position_error(shown_positions, fine_positions, areas_), std::sqrt(squares / area)};
}

}  // namespace pleat
