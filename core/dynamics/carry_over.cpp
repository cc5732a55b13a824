#include "core/dynamics/carry_over.h"

#include <algorithm>
#include <array>

#include "core/base/check.h"

namespace pleat {
namespace {

constexpr int kKinds = 4;  // of SpringKind

/// One column per vertex, one row per spring kind.
using VertexStrains = Eigen::Matrix<double, kKinds, Eigen::Dynamic>;

int row(const Spring& spring) { return static_cast<int>(spring.kind); }

/// Mean strain of the springs of each kind around each vertex.
VertexStrains vertex_strains(const ClothModel& model, const Positions& positions) {
  VertexStrains sums = VertexStrains::Zero(kKinds, positions.cols());
  VertexStrains counts = sums;
  for (const Spring& spring : model.springs) {
    if (spring.rest_length == 0) continue;
    const double length = (positions.col(spring.a) - positions.col(spring.b)).norm();
    for (const VertexId v : {spring.a, spring.b}) {
      sums.col(v)[row(spring)] += length / spring.rest_length - 1;
      counts.col(v)[row(spring)] += 1;
    }
  }
  return (counts.array() > 0).select(sums.array() / counts.array().max(1), 0.0);
}

/// Stiffness of an inner spring of each kind. It is the modulus times the cell's aspect, which
/// refinement keeps.
std::array<double, kKinds> inner_stiffness(const ClothModel& model) {
  std::array<double, kKinds> stiffness{};
  for (const Spring& spring : model.springs) {
    double& largest = stiffness[static_cast<std::size_t>(row(spring))];
    largest = std::max(largest, spring.stiffness);
  }
  return stiffness;
}

/// Copies the columns that both meshes share and fills the others with the mean of their parents,
/// which come earlier.
template <class Columns>
Columns carried_columns(const Columns& old, const QuadMesh& mesh) {
  Columns fresh(old.rows(), mesh.n_vertices());
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

}  // namespace

State carried_state(const MovingSheet& old, const QuadMesh& mesh) {
  return {carried_columns(old.state.positions, mesh), carried_columns(old.state.velocities, mesh)};
}

std::vector<double> carried_rest_lengths(const MovingSheet& old, const MovingSheet& fresh) {
  const VertexStrains strains =
      carried_columns(vertex_strains(old.model, old.state.positions), fresh.mesh);
  const std::array<double, kKinds> old_stiffness = inner_stiffness(old.model);
  const std::array<double, kKinds> fresh_stiffness = inner_stiffness(fresh.model);
  const double mass_ratio = fresh.model.masses.sum() / old.model.masses.sum();
  std::vector<double> rest_lengths;
  for (const Spring& spring : fresh.model.springs) {
    const auto kind = static_cast<std::size_t>(row(spring));
    const double old_strain =
        0.5 * (strains.col(spring.a)[row(spring)] + strains.col(spring.b)[row(spring)]);
    const double strain =
        fresh_stiffness[kind] > 0
            ? old_strain * mass_ratio * old_stiffness[kind] / fresh_stiffness[kind]
            : 0;
    const double length =
        (fresh.state.positions.col(spring.a) - fresh.state.positions.col(spring.b)).norm();
    rest_lengths.push_back(std::max(0.0, length - strain * spring.rest_length));
  }
  return rest_lengths;
}

}  // namespace pleat
