#include "core/contact/signed_distance.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/mesh/edge_key.h"

namespace pleat {
namespace {

Vec3 unit_normal(const Corners& c) { return (c[1] - c[0]).cross(c[2] - c[0]).normalized(); }

/// Angle of a triangle at its k-th corner [rad].
double angle_at(const Corners& c, std::size_t k) {
  const Vec3 a = c[(k + 1) % 3] - c[k];
  const Vec3 b = c[(k + 2) % 3] - c[k];
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

// The place seen from the nearest point of the surface lies on the side of the mean normal there:
// of the face, of an edge's two faces, of a vertex's faces weighted by their angles.
// Source: Baerentzen & Aanaes, Signed distance computation using the angle weighted pseudonormal,
// IEEE Trans. Visualization and Computer Graphics 11(3), 2005.
SignedDistance::SignedDistance(const PositionsView& places, const std::vector<Triangle>& triangles)
    : corners_(triangle_corners(triangles, places)), tree_(corners_) {
  std::vector<Vec3> of_vertices(static_cast<std::size_t>(places.cols()), Vec3::Zero());
  std::map<std::uint64_t, Vec3> of_edges;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const Vec3 normal = unit_normal(corners_[f]);
    for (std::size_t k = 0; k < 3; ++k) {
      of_vertices[triangles[f][k]] += angle_at(corners_[f], k) * normal;
      of_edges
          .try_emplace(edge_key(triangles[f][(k + 1) % 3], triangles[f][(k + 2) % 3]), Vec3::Zero())
          .first->second += normal;
    }
  }
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    Normals& normals = normals_.emplace_back();
    normals.face = unit_normal(corners_[f]);
    for (std::size_t k = 0; k < 3; ++k) {
      normals.corners[k] = of_vertices[triangles[f][k]];
      normals.edges[k] =
          of_edges.at(edge_key(triangles[f][(k + 1) % 3], triangles[f][(k + 2) % 3]));
    }
  }
}

double SignedDistance::at(const Vec3& place) {
  const TriangleTree::Nearest nearest = tree_.nearest(place);
  const Corners& corners = corners_[nearest.triangle];
  const Normals& normals = normals_[nearest.triangle];
  const Vec3 weights = nearest_weights(place, corners);
  // A weight that is zero is exactly so where an edge or a corner is nearest.
  const auto n_zero = (weights.array() == 0).count();
  Eigen::Index most = 0;
  Eigen::Index least = 0;
  weights.maxCoeff(&most);
  weights.minCoeff(&least);
  const Vec3& normal = n_zero == 0   ? normals.face
                       : n_zero == 1 ? normals.edges[static_cast<std::size_t>(least)]
                                     : normals.corners[static_cast<std::size_t>(most)];
  const Vec3 from_corner = place - corners[static_cast<std::size_t>(most)];
  Vec3 foot = Vec3::Zero();  // seen from that corner
  for (Eigen::Index k = 0; k < 3; ++k)
    foot += weights[k] *
            (corners[static_cast<std::size_t>(k)] - corners[static_cast<std::size_t>(most)]);
  const double distance = std::sqrt(nearest.distance_squared);
  return normal.dot(from_corner - foot) < 0 ? -distance : distance;
}

std::size_t SignedDistance::bytes() const {
  return corners_.capacity() * sizeof(Corners) + normals_.capacity() * sizeof(Normals) +
         tree_.bytes();
}

}  // namespace pleat
