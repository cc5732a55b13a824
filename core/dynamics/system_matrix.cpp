#include "core/dynamics/system_matrix.h"

#include <algorithm>

#include "core/base/check.h"

namespace pleat {

SystemMatrix::SystemMatrix(const ClothModel& model)
    : model_(model), below_(static_cast<std::size_t>(model.n_vertices())) {
  const auto join = [this](VertexId a, VertexId b) {
    below_[std::min(a.value, b.value)].push_back(a > b ? a : b);
  };
  for (const Spring& spring : model.springs) join(spring.a, spring.b);
  for (const BendElement& bend : model.bends) {
    join(bend.vertices[0], bend.vertices[1]);
    join(bend.vertices[1], bend.vertices[2]);
    join(bend.vertices[0], bend.vertices[2]);
  }
  const int n = model.n_vertices();
  std::vector<int> column_sizes;
  column_sizes.reserve(3 * static_cast<std::size_t>(n));
  for (std::vector<VertexId>& rows : below_) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    for (int c = 0; c < 3; ++c) column_sizes.push_back(3 - c + 3 * static_cast<int>(rows.size()));
  }
  matrix_.resize(3 * n, 3 * n);
  matrix_.reserve(column_sizes);
  for (int j = 0; j < n; ++j) {
    for (int c = 0; c < 3; ++c) {
      for (int r = c; r < 3; ++r) matrix_.insert(3 * j + r, 3 * j + c) = 0;
      for (const VertexId i : below_[j])
        for (int r = 0; r < 3; ++r) matrix_.insert(3 * i + r, 3 * j + c) = 0;
    }
  }
  matrix_.makeCompressed();
  for (const Spring& spring : model.springs) spring_slots_.push_back(slot(spring.a, spring.b));
  for (const BendElement& bend : model.bends) {
    const auto& v = bend.vertices;
    bend_slots_.push_back({slot(v[0], v[1]), slot(v[1], v[2]), slot(v[0], v[2])});
  }
}

SystemMatrix::Slot SystemMatrix::slot(VertexId a, VertexId b) const {
  const VertexId row = a > b ? a : b;
  const VertexId column = a > b ? b : a;
  const std::vector<VertexId>& rows = below_[column];
  const auto place = std::lower_bound(rows.begin(), rows.end(), row);
  return {row, column, static_cast<int>(place - rows.begin())};
}

/// The three values of one column of a block lie side by side, behind the column's share of the
/// diagonal block.
double* SystemMatrix::block_column(const Slot& slot, int component) {
  const int column = 3 * slot.column + component;
  return matrix_.valuePtr() + matrix_.outerIndexPtr()[column] + (3 - component) + 3 * slot.rank;
}

void SystemMatrix::add_block(const Slot& slot, const Mat3& block) {
  for (int c = 0; c < 3; ++c) {
    double* values = block_column(slot, c);
    for (int r = 0; r < 3; ++r) values[r] += block(r, c);
  }
}

void SystemMatrix::add_diagonal(VertexId vertex, const Mat3& block) {
  for (int c = 0; c < 3; ++c) {
    double* values = matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * vertex + c];
    for (int r = c; r < 3; ++r) values[r - c] += block(r, c);
  }
}

void SystemMatrix::set_zero() { matrix_.coeffs().setZero(); }

void SystemMatrix::add_masses(const Eigen::VectorXd& masses, double factor) {
  for (int j = 0; j < model_.n_vertices(); ++j)
    for (int c = 0; c < 3; ++c)
      matrix_.valuePtr()[matrix_.outerIndexPtr()[3 * j + c]] += factor * masses[j];
}

void SystemMatrix::add_spring(std::size_t index, const Mat3& block) {
  const Spring& spring = model_.springs[index];
  add_diagonal(spring.a, block);
  add_diagonal(spring.b, block);
  add_block(spring_slots_[index], -block);
}

void SystemMatrix::add_bend(std::size_t index, double factor) {
  const BendElement& bend = model_.bends[index];
  const auto& w = bend.weights;
  const double s = factor * bend.stiffness;
  for (int k = 0; k < 3; ++k) add_diagonal(bend.vertices[k], s * w[k] * w[k] * Mat3::Identity());
  add_block(bend_slots_[index][0], s * w[0] * w[1] * Mat3::Identity());
  add_block(bend_slots_[index][1], s * w[1] * w[2] * Mat3::Identity());
  add_block(bend_slots_[index][2], s * w[0] * w[2] * Mat3::Identity());
}

void SystemMatrix::choose_prescribed(const std::vector<VertexId>& vertices) {
  prescribed_ = vertices;
  std::vector<int> index(below_.size(), -1);
  for (std::size_t k = 0; k < vertices.size(); ++k) index[vertices[k]] = static_cast<int>(k);
  prescribed_blocks_.clear();
  for (std::size_t j = 0; j < below_.size(); ++j) {
    for (std::size_t rank = 0; rank < below_[j].size(); ++rank) {
      const VertexId row = below_[j][rank];
      if (index[row] < 0 && index[j] < 0) continue;
      const Slot place{row, VertexId(static_cast<std::int64_t>(j)), static_cast<int>(rank)};
      prescribed_blocks_.push_back({place, index[row], index[j]});
    }
  }
}

void SystemMatrix::prescribe(const Eigen::Ref<const Positions>& values,
                             Eigen::Ref<Eigen::VectorXd> rhs) {
  PLEAT_CHECK(values.cols() == static_cast<Eigen::Index>(prescribed_.size()),
              "one value per prescribed vertex");
  for (const PrescribedBlock& entry : prescribed_blocks_) {
    for (int c = 0; c < 3; ++c) {
      double* column = block_column(entry.slot, c);
      for (int r = 0; r < 3; ++r) {
        if (entry.row_index < 0)
          rhs[3 * entry.slot.row + r] -= column[r] * values(c, entry.column_index);
        if (entry.column_index < 0)
          rhs[3 * entry.slot.column + c] -= column[r] * values(r, entry.row_index);
        column[r] = 0;
      }
    }
  }
  for (std::size_t k = 0; k < prescribed_.size(); ++k) {
    const VertexId v = prescribed_[k];
    for (int c = 0; c < 3; ++c) {
      double* diagonal = matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * v + c];
      for (int r = c; r < 3; ++r) diagonal[r - c] = r == c ? 1 : 0;
      rhs[3 * v + c] = values(c, static_cast<Eigen::Index>(k));
    }
  }
}

SparseMatrix stiffness_matrix(const ClothModel& model, const Eigen::Ref<const Positions>& positions,
                              SpringHessian hessian) {
  SystemMatrix matrix(model);
  for (std::size_t s = 0; s < model.springs.size(); ++s) {
    const Spring& spring = model.springs[s];
    matrix.add_spring(s, spring_stiffness(spring, spring_axis(spring, positions), hessian));
  }
  for (std::size_t b = 0; b < model.bends.size(); ++b) matrix.add_bend(b, 1);
  return matrix.lower();
}

SparseMatrix damping_matrix(const ClothModel& model, const Eigen::Ref<const Positions>& positions) {
  SystemMatrix matrix(model);
  for (std::size_t s = 0; s < model.springs.size(); ++s) {
    const Spring& spring = model.springs[s];
    matrix.add_spring(
        s, spring_damping(spring, spring_axis(spring, positions), model.damping_direction));
  }
  return matrix.lower();
}

SparseMatrix mass_matrix(const ClothModel& model) {
  const int n = 3 * model.n_vertices();
  SparseMatrix matrix(n, n);
  matrix.reserve(Eigen::VectorXi::Constant(n, 1));
  for (int i = 0; i < n; ++i) matrix.insert(i, i) = model.masses[i / 3];
  matrix.makeCompressed();
  return matrix;
}

}  // namespace pleat
