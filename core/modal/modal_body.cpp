#include "core/modal/modal_body.h"

#include <algorithm>
#include <string>

#include "core/base/check.h"
#include "core/base/rigid_motion.h"
#include "core/modal/arap_energy.h"
#include "core/modal/shape_clusters.h"

namespace pleat {
namespace {

constexpr double kCubes = 4000;
constexpr int kUsualModes = 40;
constexpr int kPoints = 256;  // points that tell what stays; as many for any mesh
double enclosed_volume(const Positions& surface, const std::vector<Triangle>& triangles) {
  const Vec3 origin = surface.rowwise().mean();
  double six_volumes = 0;
  for (const auto& [a, b, c] : triangles)
    six_volumes +=
        (surface.col(a) - origin).dot((surface.col(b) - origin).cross(surface.col(c) - origin));
  return std::abs(six_volumes) / 6;
}

/// Vertices far from each other, each next one the farthest from all before.
std::vector<VertexId> spread_points(const Positions& surface, int count) {
  std::vector<VertexId> points{VertexId(0)};
  Eigen::RowVectorXd squares = (surface.colwise() - surface.col(0)).colwise().squaredNorm();
  while (static_cast<int>(points.size()) < std::min<Eigen::Index>(count, surface.cols())) {
    Eigen::Index farthest = 0;
    squares.maxCoeff(&farthest);
    points.emplace_back(static_cast<int>(farthest));
    squares = squares.cwiseMin((surface.colwise() - surface.col(farthest)).colwise().squaredNorm());
  }
  return points;
}

Eigen::VectorXd of_each_coordinate(const Eigen::VectorXd& of_vertex) {
  return of_vertex.replicate(1, 3).transpose().reshaped();
}

bool has_turned_inside_out(const TetMesh& mesh) {
  return std::any_of(mesh.tets.begin(), mesh.tets.end(),
                     [&](const Tet& tet) { return tet_volume(mesh.rest_positions, tet) <= 0; });
}

}  // namespace

bool is_closed(const std::vector<Triangle>& triangles) {
  const std::vector<MeshEdge> edges = mesh_edges(triangles);
  return std::none_of(edges.begin(), edges.end(), [](const MeshEdge& e) { return e.is_border(); });
}

VolumeKind volume_kind(const std::vector<Triangle>& triangles, const ModalOptions& options) {
  return options.volume.value_or(is_closed(triangles) ? VolumeKind::lattice : VolumeKind::shell);
}

CarryingVolume carrying_volume(const Positions& surface, const std::vector<Triangle>& triangles,
                               const ModalOptions& options) {
  if (volume_kind(triangles, options) == VolumeKind::lattice) {
    if (options.size > 0 || !is_closed(triangles))  // it refuses an open surface
      return lattice_volume(surface, triangles, options.size > 0 ? options.size : 1);
    const double volume = enclosed_volume(surface, triangles);
    if (!(volume > 0)) throw InputError("", "expected a surface that encloses a volume");
    return lattice_volume(surface, triangles, std::cbrt(volume / kCubes));
  }
  const double usual = mean_edge_length(surface, triangles);
  return shell_volume(surface, triangles, options.size > 0 ? options.size : usual);
}

SolveReport volume_modes(const TetMesh& rest, int count, Modes& modes) {
  const Eigen::MatrixXd rigid = rigid_motions(rest.rest_positions, parts_by_vertices(rest));
  const Eigen::Index most = 3 * rest.n_vertices() - rigid.cols();
  if (count == 0) count = static_cast<int>(std::min<Eigen::Index>(kUsualModes, most));
  if (count < 1 || count > most)
    throw InputError("", "expected 1 to " + std::to_string(most) + " modes, all that " +
                             std::to_string(rest.n_vertices()) +
                             " vertices of a volume have, found " + std::to_string(count));
  constexpr double kYoung = 1;
  return lowest_modes(ArapEnergy(rest, kYoung / 2).hessian(rest.rest_positions),
                      of_each_coordinate(vertex_volumes(rest)), rigid, count, modes);
}

VolumeFit usual_fit(const CarryingVolume& carrying) {
  constexpr double kAttachment = 1e4;  // factor over the square of the body's size
  const double extent = box_diagonal(carrying.volume.rest_positions);
  return {carrying, kAttachment / (extent * extent)};
}

std::vector<Positions> key_volumes(const CarryingVolume& carrying, const VolumeFit& fit,
                                   const std::vector<Positions>& keys) {
  std::vector<Positions> volumes{carrying.volume.rest_positions};
  for (std::size_t k = 1; k < keys.size(); ++k) {
    // The rigid part of the motion need not be found step by step.
    volumes.push_back(nearest_rigid_motion(keys[k - 1], keys[k]).of(volumes.back()));
    const SolveReport fitted = fit.fit(keys[k], volumes.back());
    if (fitted.ends_run())
      throw InputError("", "the volume of key " + std::to_string(k) + ": " + fitted.message);
  }
  return volumes;
}

ModalBody::ModalBody(const std::vector<Positions>& keys, const std::vector<Triangle>& triangles,
                     const ModalOptions& options)
    : carrying_(carrying_volume(keys.front(), triangles, options)),
      detail_beyond_(options.detail_beyond),
      fit_(usual_fit(carrying_)),
      keys_(keys.size()) {
  const std::vector<Positions> volumes = key_volumes(carrying_, fit_, keys);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    keys_[k].volume = volumes[k];
    const TetMesh as_rest{volumes[k], carrying_.volume.tets};
    if (has_turned_inside_out(as_rest)) continue;
    Modes modes;
    const SolveReport report = volume_modes(as_rest, options.n_modes, modes);
    if (report.ends_run())
      throw InputError("", "the modes of key " + std::to_string(k) + ": " + report.message);
    modes_.push_back(std::move(modes));
  }
  std::vector<Positions> exact;
  if (options.exact_keys) exact = volumes;
  space_ = shape_space(carrying_.volume.rest_positions, vertex_volumes(carrying_.volume), modes_,
                       exact, options.n_functions);
  cluster_of_tet_ = shape_clusters(carrying_.volume, space_, options.n_clusters);
  arap_ = std::make_unique<ReducedArap>(carrying_.volume, space_, cluster_of_tet_);
  detail_ = std::make_unique<SurfaceDetail>(carrying_, cluster_of_tet_);
  surface_functions_ = space_.functions * carrying_.embedding;
  const std::vector<VertexId> points = spread_points(keys.front(), kPoints);
  points_.resize(space_.size(), static_cast<Eigen::Index>(points.size()));
  for (std::size_t p = 0; p < points.size(); ++p)
    points_.col(static_cast<Eigen::Index>(p)) = surface_functions_.col(points[p]);
  for (std::size_t k = 0; k < keys.size(); ++k) take(keys_[k], keys[k]);
}

void ModalBody::take(Key& key, const Positions& surface) const {
  key.shape.key = arap_->key(space_.coordinates(key.volume));
  key.residual = surface - key.shape.key.shape * surface_functions_;
  detail_->keep_beyond(detail_beyond_, key.residual);
}

SolveReport ModalBody::replace_key(int index, const Positions& surface) {
  Key& key = keys_[static_cast<std::size_t>(index)];
  const Positions before = carrying_.surface(key.volume);
  key.volume = nearest_rigid_motion(before, surface).of(key.volume);
  SolveReport report = fit_.fit(surface, key.volume);
  if (!report.ends_run()) take(key, surface);
  return report;
}

// Coordinates beside the constant function are about the centroid; the functions are orthonormal.
ModalBody::Shape ModalBody::middle(const Shape& a, const Shape& b) const {
  const auto about_centroid = [](const Shape& shape) -> ShapeCoordinates {
    ShapeCoordinates coordinates = shape.key.shape;
    coordinates.col(0).setZero();
    return coordinates;
  };
  const ShapeCoordinates from = about_centroid(a);
  const ShapeCoordinates to = about_centroid(b);
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(space_.size());
  const ReducedArap::Key facing =
      ReducedArap::turned(b.key, best_turn(from, to, weights).transpose());
  MiddleShape middle = middle_shape(*arap_->blend(a.key, facing), arap_->scale());
  turn_half_way(from, to, weights, middle.shape);
  const Vec3 shift =
      shift_half_way(a.key.shape * points_, b.key.shape * points_, middle.shape * points_);
  middle.shape.col(0) += shift / space_.functions(0, 0);
  return {arap_->key(middle.shape), middle.distances, middle.converged};
}

Positions ModalBody::surface(const Shape& shape, int left, double share_of_next) const {
  Positions surface = shape.key.shape * surface_functions_;
  const auto carry = [&](int index, double share) {
    if (share == 0) return;
    const Key& key = keys_[static_cast<std::size_t>(index)];
    detail_->add(key.residual, ReducedArap::rotations(key.shape.key, shape.key.shape), share,
                 surface);
  };
  carry(left, 1 - share_of_next);
  carry(left + 1, share_of_next);
  return surface;
}

}  // namespace pleat
