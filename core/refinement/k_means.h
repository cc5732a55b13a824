#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/random.h"

namespace pleat {

using PlanePoints = Eigen::Matrix<double, 2, Eigen::Dynamic>;

/// Points sorted into clusters, each to the nearest centre, which is the mean of its points.
struct Clusters {
  PlanePoints centres;
  std::vector<int> of_points;
  double within = 0;  ///< squared distances of the points from their centres, summed
};

/// The best of several runs of Lloyd's algorithm from random centres, each drawn with a probability
/// that grows with the square of its distance from those drawn before (k-means++). A cluster that
/// loses all points begins again at the point farthest from its centre.
///
/// points  finite
/// k       clusters, at least 1
/// n_runs  at least 1
/// Throws InputError when fewer than k points differ.
/// Source: Arthur & Vassilvitskii, k-means++: the advantages of careful seeding, SODA 2007.
Clusters k_means(const PlanePoints& points, int k, int n_runs, Random& random);

}  // namespace pleat
