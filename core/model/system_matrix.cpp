#include "core/model/system_matrix.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/model/hanging_vertices.h"

namespace pleat {

namespace {

/// Calls join(a, b) for every pair of vertices that an element joins, in the order of assembly.
template <class Join>
void for_each_pair(const ClothModel& model, Join&& join) {
  const auto join_all = [&join](const auto& vertices) {
    for (std::size_t i = 0; i < vertices.size(); ++i)
      for (std::size_t j = i + 1; j < vertices.size(); ++j) join(vertices[i], vertices[j]);
  };
  for (const Spring& spring : model.springs) join(spring.a, spring.b);
  for (const Spring& spring : model.taut_springs) join(spring.a, spring.b);
  for (const BendElement& bend : model.bends) join_all(bend.vertices);
  for (const ChordBend& bend : model.chord_bends) join(bend.a, bend.b);
  for (const MembraneElement& element : model.membrane.elements) join_all(element.vertices);
  for (const Hinge& hinge : model.hinges) join_all(hinge.vertices);
  const SparseMatrix& bending = model.fitted_bending;
  for (int column = 0; column < bending.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(bending, column); entry; ++entry)
      if (entry.row() > column) join(VertexId(entry.row()), VertexId(column));
}

}  // namespace

SystemMatrix::SystemMatrix(const ClothModel& model)
    : model_(model), below_(static_cast<std::size_t>(model.n_vertices())) {
  for_each_pair(model, [this](VertexId a, VertexId b) {
    below_[std::min(a.value, b.value)].push_back(a > b ? a : b);
  });
  if (!model.hanging.empty()) join_parents();
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
  for_each_pair(model, [this](VertexId a, VertexId b) { slots_.push_back(slot(a, b)); });
  find_hanging_slots();
}

/// Eliminates hanging vertices as `reduce_to_parents` will, to see what it fills. Neighbours may
/// hang too: what the first one leaves with the second goes on to the second one's parents.
void SystemMatrix::join_parents() {
  std::vector<std::vector<VertexId>> neighbours(below_.size());
  const auto note = [&neighbours](VertexId a, VertexId b) {
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  };
  for (std::size_t j = 0; j < below_.size(); ++j)
    for (const VertexId i : below_[j]) note(i, VertexId(static_cast<std::int64_t>(j)));
  const auto join = [&](VertexId a, VertexId b) {
    note(a, b);
    below_[std::min(a.value, b.value)].push_back(a > b ? a : b);
  };
  std::vector<bool> is_eliminated(below_.size(), false);
  for (const HangingVertex& h : model_.hanging) {
    std::vector<VertexId>& others = neighbours[h.vertex];
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    hanging_blocks_.push_back({h, {}, {}});
    for (const VertexId other : others) {
      if (is_eliminated[other]) continue;
      hanging_blocks_.back().blocks.push_back({other, {}, {}});
      for (const VertexId parent : h.parents)
        if (parent != other) join(parent, other);
    }
    join(h.parents[0], h.parents[1]);
    is_eliminated[h.vertex] = true;
  }
}

void SystemMatrix::find_hanging_slots() {
  for (HangingBlocks& h : hanging_blocks_) {
    const auto& parents = h.hanging.parents;
    h.between_parents = slot(parents[0], parents[1]);
    for (HangingBlock& block : h.blocks) {
      block.own = slot(h.hanging.vertex, block.other);
      for (std::size_t k = 0; k < 2; ++k)
        if (parents[k] != block.other) block.of_parents[k] = slot(parents[k], block.other);
    }
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

double SystemMatrix::diagonal_trace(VertexId vertex) const {
  double trace = 0;
  for (int c = 0; c < 3; ++c) trace += matrix_.valuePtr()[matrix_.outerIndexPtr()[3 * vertex + c]];
  return trace;
}

void SystemMatrix::add_diagonal(VertexId vertex, const Mat3& block) {
  for (int c = 0; c < 3; ++c) {
    double* values = matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * vertex + c];
    for (int r = c; r < 3; ++r) values[r - c] += block(r, c);
  }
}

/// The block in the row of `row`, which is left zero.
Mat3 SystemMatrix::take_block(const Slot& slot, VertexId row) {
  Mat3 block;
  for (int c = 0; c < 3; ++c) {
    Eigen::Map<Vec3> values(block_column(slot, c));
    block.col(c) = values;
    values.setZero();
  }
  return slot.row == row ? block : Mat3(block.transpose());
}

/// The block on the diagonal, which is left the identity.
Mat3 SystemMatrix::take_diagonal(VertexId vertex) {
  Mat3 block;
  for (int c = 0; c < 3; ++c) {
    double* values = matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * vertex + c];
    for (int r = c; r < 3; ++r) {
      block(r, c) = block(c, r) = values[r - c];
      values[r - c] = r == c ? 1 : 0;
    }
  }
  return block;
}

void SystemMatrix::add_multiple_of_identity(const Slot& slot, double factor) {
  for (int c = 0; c < 3; ++c) block_column(slot, c)[c] += factor;
}

void SystemMatrix::add_to_diagonal(VertexId vertex, double factor) {
  for (int c = 0; c < 3; ++c) matrix_.valuePtr()[matrix_.outerIndexPtr()[3 * vertex + c]] += factor;
}

void SystemMatrix::add_spring(const Spring& spring, const Slot& slot, const Mat3& block) {
  add_diagonal(spring.a, block);
  add_diagonal(spring.b, block);
  add_block(slot, -block);
}

template <std::size_t n>
void SystemMatrix::add_element(const std::array<VertexId, n>& vertices, const Slot*& slots,
                               const Eigen::Matrix<double, 3 * n, 3 * n>& block) {
  for (std::size_t i = 0; i < n; ++i) {
    add_diagonal(vertices[i], block.template block<3, 3>(3 * i, 3 * i));
    for (std::size_t j = i + 1; j < n; ++j, ++slots) {
      const Mat3 pair = block.template block<3, 3>(3 * i, 3 * j);
      add_block(*slots, vertices[i] > vertices[j] ? pair : Mat3(pair.transpose()));
    }
  }
}

void SystemMatrix::set_zero() { matrix_.coeffs().setZero(); }

void SystemMatrix::set_values(const SparseMatrix& lower) {
  PLEAT_CHECK(lower.nonZeros() == matrix_.nonZeros(), "values come with the same pattern");
  matrix_.coeffs() = lower.coeffs();
}

void SystemMatrix::add_masses(double factor) {
  for (int j = 0; j < model_.n_vertices(); ++j)
    add_to_diagonal(VertexId(j), factor * model_.masses[j]);
}

void SystemMatrix::add_elasticity(const Eigen::Ref<const Positions>& positions,
                                  double stiffness_factor, double damping_factor,
                                  ElementHessian hessian) {
  const Slot* slots = slots_.data();
  for (const Spring& spring : model_.springs) {
    const SpringAxis axis = spring_axis(spring, positions);
    add_spring(spring, *slots++,
               stiffness_factor * spring_stiffness(spring, axis, hessian) +
                   damping_factor * spring_damping(spring, axis, model_.damping_direction));
  }
  for (const Spring& spring : model_.taut_springs) {
    const SpringAxis axis = spring_axis(spring, positions);
    if (axis.length > spring.rest_length)
      add_spring(spring, *slots, stiffness_factor * spring_stiffness(spring, axis, hessian));
    ++slots;
  }
  for (const BendElement& bend : model_.bends) {
    const auto& w = bend.weights;
    const double s = stiffness_factor * bend.stiffness;
    for (int i = 0; i < 3; ++i) {
      add_to_diagonal(bend.vertices[i], s * w[i] * w[i]);
      for (int j = i + 1; j < 3; ++j) add_multiple_of_identity(*slots++, s * w[i] * w[j]);
    }
  }
  for (const ChordBend& bend : model_.chord_bends) {
    const Mat3 block = stiffness_factor * chord_stiffness(bend, positions, hessian);
    add_diagonal(bend.a, block);
    add_diagonal(bend.b, block);
    add_block(*slots++, -block);
  }
  const double viscosity_factor = damping_factor * model_.membrane_relaxation;
  for (const MembraneElement& element : model_.membrane.elements) {
    Eigen::Matrix<double, 9, 9> block =
        stiffness_factor * membrane_stiffness(model_.membrane.law, element, positions, hessian);
    if (viscosity_factor > 0)
      block += viscosity_factor * membrane_viscosity(model_.membrane.law, element, positions);
    add_element(element.vertices, slots, block);
  }
  for (const Hinge& hinge : model_.hinges)
    add_element(hinge.vertices, slots,
                stiffness_factor * hinge_stiffness(hinge, positions, hessian));
  const SparseMatrix& bending = model_.fitted_bending;
  for (int column = 0; column < bending.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator entry(bending, column); entry; ++entry) {
      const double q = stiffness_factor * entry.value();
      if (entry.row() > column)
        add_multiple_of_identity(*slots++, q);
      else
        add_to_diagonal(VertexId(column), q);
    }
  }
}

// With x_h = (y_p + y_q)/2 the block A_hj gives half of itself to (p, j) and (q, j), and as A_jh
// half to (j, p) and (j, q): both at once where j is p or q. A_hh gives a quarter to each of the
// four between p and q.
void SystemMatrix::reduce_to_parents(Eigen::Ref<Eigen::VectorXd> rhs) {
  for (const HangingBlocks& h : hanging_blocks_) {
    const auto& parents = h.hanging.parents;
    for (const HangingBlock& block : h.blocks) {
      const Mat3 half = take_block(block.own, h.hanging.vertex) / 2;
      for (std::size_t k = 0; k < 2; ++k) {
        if (parents[k] == block.other)
          add_diagonal(parents[k], half + half.transpose());
        else
          add_block(block.of_parents[k],
                    block.of_parents[k].row == parents[k] ? half : Mat3(half.transpose()));
      }
    }
    const Mat3 quarter = take_diagonal(h.hanging.vertex) / 4;
    for (const VertexId parent : parents) add_diagonal(parent, quarter);
    add_block(h.between_parents, quarter);
  }
  pull_to_parents(model_.hanging, Eigen::Map<Positions>(rhs.data(), 3, model_.n_vertices()));
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
                              ElementHessian hessian) {
  SystemMatrix matrix(model);
  matrix.add_elasticity(positions, 1, 0, hessian);
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
