#include "core/modal/shape_clusters.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/base/random.h"
#include "core/modal/tet_element.h"

namespace pleat {
namespace {

constexpr int kMostFunctions = 8;  // the lighter ones bend less than a cluster is long
constexpr int kMostMoves = 12;

using Points = Eigen::MatrixXf;  // one per column

/// The gradients of the heaviest functions in each tetrahedron, each as large as the function's
/// weight makes it.
Points gradients(const std::vector<TetElement>& elements, const ShapeSpace& space) {
  const int n_functions = std::min(kMostFunctions, space.size() - kAffineFunctions);
  const auto functions = space.functions.middleRows(kAffineFunctions, n_functions);
  const auto weights = space.weights.segment(kAffineFunctions, n_functions);
  Points points(3 * n_functions, static_cast<Eigen::Index>(elements.size()));
  for (std::size_t t = 0; t < elements.size(); ++t) {
    Eigen::MatrixXd of_tet = Eigen::MatrixXd::Zero(n_functions, 3);
    for (int k = 0; k < 4; ++k)
      of_tet += functions.col(elements[t].tet[static_cast<std::size_t>(k)]) *
                elements[t].to_gradient.row(k);
    of_tet = weights.asDiagonal() * of_tet;
    points.col(static_cast<Eigen::Index>(t)) = of_tet.reshaped().cast<float>();
  }
  return points;
}

/// Each next one is drawn with the chance that the squares of the distances from those before
/// give it.
Points first_centres(const Points& points, int count) {
  Random random(1);
  Points centres(points.rows(), count);
  centres.col(0) = points.col(0);
  Eigen::VectorXd squares =
      (points.colwise() - points.col(0)).colwise().squaredNorm().transpose().cast<double>();
  for (int c = 1; c < count; ++c) {
    double draw = random.uniform(0, squares.sum());
    Eigen::Index chosen = 0;
    while (chosen + 1 < points.cols() && draw >= squares[chosen]) draw -= squares[chosen++];
    centres.col(c) = points.col(chosen);
    squares = squares.cwiseMin(
        (points.colwise() - centres.col(c)).colwise().squaredNorm().transpose().cast<double>());
  }
  return centres;
}

/// |p - c|^2 = |p|^2 - 2 p.c + |c|^2, of which the first is alike for all c.
std::vector<int> nearest_centres(const Points& points, const Points& centres) {
  constexpr Eigen::Index kBatch = 1024;
  const Eigen::VectorXf squares = centres.colwise().squaredNorm().transpose();
  std::vector<int> nearest(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index first = 0; first < points.cols(); first += kBatch) {
    const Eigen::Index n = std::min(kBatch, points.cols() - first);
    Points distances = -2 * centres.transpose() * points.middleCols(first, n);
    distances.colwise() += squares;
    for (Eigen::Index p = 0; p < n; ++p) {
      Eigen::Index of = 0;
      distances.col(p).minCoeff(&of);
      nearest[static_cast<std::size_t>(first + p)] = static_cast<int>(of);
    }
  }
  return nearest;
}

void move_to_means(const Points& points, const std::vector<int>& cluster_of, Points& centres) {
  Points sums = Points::Zero(centres.rows(), centres.cols());
  Eigen::VectorXi counts = Eigen::VectorXi::Zero(centres.cols());
  for (Eigen::Index p = 0; p < points.cols(); ++p) {
    const int of = cluster_of[static_cast<std::size_t>(p)];
    sums.col(of) += points.col(p);
    ++counts[of];
  }
  for (Eigen::Index c = 0; c < centres.cols(); ++c)
    if (counts[c] > 0) centres.col(c) = sums.col(c) / static_cast<float>(counts[c]);
}

/// Numbers clusters without gaps, in the order in which they first occur.
void renumber(std::vector<int>& cluster_of, int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count), -1);
  int n_used = 0;
  for (int& cluster : cluster_of) {
    int& number = numbers[static_cast<std::size_t>(cluster)];
    if (number < 0) number = n_used++;
    cluster = number;
  }
}

}  // namespace

std::vector<int> shape_clusters(const TetMesh& rest, const ShapeSpace& space, int count) {
  PLEAT_CHECK(count > 0 && rest.n_vertices() == space.functions.cols(),
              "a space of the volume's own vertices, in one or more clusters");
  const int n_tets = static_cast<int>(rest.tets.size());
  count = std::min(count, n_tets);
  if (space.size() == kAffineFunctions) return std::vector<int>(rest.tets.size(), 0);
  const Points points = gradients(tet_elements(rest), space);
  Points centres = first_centres(points, count);
  std::vector<int> cluster_of = nearest_centres(points, centres);
  for (int turn = 0; turn < kMostMoves; ++turn) {
    move_to_means(points, cluster_of, centres);
    std::vector<int> next = nearest_centres(points, centres);
    if (next == cluster_of) break;
    cluster_of = std::move(next);
  }
  renumber(cluster_of, count);
  return cluster_of;
}

}  // namespace pleat
