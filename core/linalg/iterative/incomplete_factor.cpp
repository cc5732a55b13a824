#include "core/linalg/iterative/incomplete_factor.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/vec.h"

namespace pleat {
namespace {

/// A pivot that keeps less of its block's trace has lost its digits in all directions.
constexpr double kLeastPivot = 1e-8;

/// Share of the diagonal's trace from which on the positive part of a block counts: smaller ones,
/// as bending's are, cost few pivots.
constexpr double kLeastPositive = 0.01;

/// The symmetric part of a 3 x 3 block without its negative eigenvalues, packed.
std::array<double, kPackedSize> positive_part(const double* block) {
  const Eigen::Map<const Mat3> B(block);  // transposed, which is as good
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen((B + B.transpose()) / 2);
  const Mat3 part = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
                    eigen.eigenvectors().transpose();
  return {part(0, 0), part(1, 0), part(1, 1), part(2, 0), part(2, 1), part(2, 2)};
}

/// y -= B x
inline void subtract_product(const double* B, const double* x, double* y) {
  y[0] -= B[0] * x[0] + B[1] * x[1] + B[2] * x[2];
  y[1] -= B[3] * x[0] + B[4] * x[1] + B[5] * x[2];
  y[2] -= B[6] * x[0] + B[7] * x[1] + B[8] * x[2];
}

/// y -= B' x
inline void subtract_transposed_product(const double* B, const double* x, double* y) {
  y[0] -= B[0] * x[0] + B[3] * x[1] + B[6] * x[2];
  y[1] -= B[1] * x[0] + B[4] * x[1] + B[7] * x[2];
  y[2] -= B[2] * x[0] + B[5] * x[1] + B[8] * x[2];
}

/// True when an eigenvalue of a block's symmetric part is `least` or more.
bool reaches(const double* B, double least) {
  const double half[3] = {(B[1] + B[3]) / 2, (B[2] + B[6]) / 2, (B[5] + B[7]) / 2};
  // Sylvester: least - B is positive definite if its leading minors are positive.
  const double a = least - B[0];
  const double b = least - B[4];
  const double c = least - B[8];
  const double minor = a * b - half[0] * half[0];
  const double determinant =
      c * minor - a * half[2] * half[2] - b * half[1] * half[1] - 2 * half[0] * half[1] * half[2];
  return !(a > 0 && minor > 0 && determinant > 0);
}

/// B += factor S for a packed symmetric S.
void add_packed(double factor, const double* S, double* B) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      B[3 * r + c] += factor * (r < c ? S[c * (c + 1) / 2 + r] : S[r * (r + 1) / 2 + c]);
}

/// T -= B S B' for packed symmetric S and T.
void subtract_congruent(const double* B, const double* S, double* T) {
  for (int r = 0; r < 3; ++r) {
    double row[3];  // row of B S
    multiply_packed(S, B + 3 * r, row);
    for (int c = 0; c <= r; ++c)
      T[r * (r + 1) / 2 + c] -= row[0] * B[3 * c] + row[1] * B[3 * c + 1] + row[2] * B[3 * c + 2];
  }
}

double trace(const double* S) { return S[0] + S[2] + S[5]; }

}  // namespace

void IncompleteFactor::analyze(const SparseMatrix& lower) {
  N_.analyze(lower);
  for (std::vector<double>* blocks : {&pivots_, &inverses_, &remainders_})
    blocks->resize(static_cast<std::size_t>(N_.n_rows()) * kPackedSize);
}

void IncompleteFactor::lift_positive_parts() {
  lifted_.clear();
  Lifted part;
  for (part.row = 0; part.row < N_.n_rows(); ++part.row) {
    for (int k = N_.begin(part.row); k < N_.begin(part.row + 1); ++k) {
      part.column = N_.column(k);
      const double least = kLeastPositive * std::min(trace(N_.diagonal_block(part.row)),
                                                     trace(N_.diagonal_block(part.column)));
      if (!reaches(N_.block(k), least)) continue;
      part.positive = positive_part(N_.block(k));
      add_packed(-1, part.positive.data(), N_.block(k));
      part.block = k;
      lifted_.push_back(part);
    }
  }
  for (const Lifted& lifted : lifted_)
    for (const int row : {lifted.row, lifted.column})
      for (std::size_t i = 0; i < kPackedSize; ++i) N_.diagonal_block(row)[i] += lifted.positive[i];
}

int IncompleteFactor::compute(const SparseMatrix& lower) {
  N_.set_values(lower);
  for (int row = 0; row < N_.n_rows(); ++row)
    if (!invert_packed(N_.diagonal_block(row), inverses_.data() + row * kPackedSize)) return row;
  lift_positive_parts();
  for (int row = 0; row < N_.n_rows(); ++row) {
    const double* D = N_.diagonal_block(row);
    double* P = pivots_.data() + row * kPackedSize;
    double* P_inverse = inverses_.data() + row * kPackedSize;
    std::copy_n(D, kPackedSize, P);
    for (int k = N_.begin(row); k < N_.begin(row + 1); ++k)
      subtract_congruent(N_.block(k), inverse(N_.column(k)), P);
    if (!(trace(P) > kLeastPivot * trace(D)) || !invert_packed(P, P_inverse)) {
      std::copy_n(D, kPackedSize, P);
      invert_packed(P, P_inverse);
    }
    for (int k = 0; k < kPackedSize; ++k) remainders_[row * kPackedSize + k] = D[k] - 2 * P[k];
  }
  return -1;
}

/// y -= E x
void IncompleteFactor::subtract_lifted(const double* x, double* y) const {
  for (const Lifted& lifted : lifted_) {
    double stretch[3];
    double force[3];
    for (int k = 0; k < 3; ++k) stretch[k] = x[3 * lifted.row + k] - x[3 * lifted.column + k];
    multiply_packed(lifted.positive.data(), stretch, force);
    for (int k = 0; k < 3; ++k) {
      y[3 * lifted.row + k] -= force[k];
      y[3 * lifted.column + k] += force[k];
    }
  }
}

void IncompleteFactor::copy_matrix(BlockMatrix& A) const {
  A = N_;
  for (const Lifted& lifted : lifted_) {
    add_packed(1, lifted.positive.data(), A.block(lifted.block));
    for (const int row : {lifted.row, lifted.column})
      for (std::size_t i = 0; i < kPackedSize; ++i) A.diagonal_block(row)[i] -= lifted.positive[i];
  }
}

void IncompleteFactor::multiply(const double* x, double* y) const {
  N_.multiply(x, y);
  subtract_lifted(x, y);
}

double IncompleteFactor::multiply_pivots(const double* r, double* z) const {
  double product = 0;
  for (int row = 0; row < N_.n_rows(); ++row) {
    const double* r_row = r + 3 * row;
    double* z_row = z + 3 * row;
    multiply_packed(pivot(row), r_row, z_row);
    product += r_row[0] * z_row[0] + r_row[1] * z_row[1] + r_row[2] * z_row[2];
  }
  return product;
}

void IncompleteFactor::solve_lower(const double* b, double* x) const {
  for (int row = 0; row < N_.n_rows(); ++row) {
    double rest[3] = {b[3 * row], b[3 * row + 1], b[3 * row + 2]};
    for (int k = N_.begin(row); k < N_.begin(row + 1); ++k)
      subtract_product(N_.block(k), x + 3 * N_.column(k), rest);
    multiply_packed(inverse(row), rest, x + 3 * row);
  }
}

double IncompleteFactor::norm_of_lower_product(const double* r) const {
  double squared = 0;
  for (int row = 0; row < N_.n_rows(); ++row) {
    double negative[3];
    const double r_row[3] = {-r[3 * row], -r[3 * row + 1], -r[3 * row + 2]};
    multiply_packed(pivot(row), r_row, negative);
    for (int k = N_.begin(row); k < N_.begin(row + 1); ++k)
      subtract_product(N_.block(k), r + 3 * N_.column(k), negative);
    squared += negative[0] * negative[0] + negative[1] * negative[1] + negative[2] * negative[2];
  }
  return std::sqrt(squared);
}

// s first gathers what later rows take from (P + L') t = p, then is -E t until its row's turn.
double IncompleteFactor::apply(const double* p, double* t, double* s) const {
  for (int row = N_.n_rows() - 1; row >= 0; --row) {
    const double rest[3] = {p[3 * row] + s[3 * row], p[3 * row + 1] + s[3 * row + 1],
                            p[3 * row + 2] + s[3 * row + 2]};
    double t_row[3];
    multiply_packed(inverse(row), rest, t_row);
    for (int k = N_.begin(row); k < N_.begin(row + 1); ++k)
      subtract_transposed_product(N_.block(k), t_row, s + 3 * N_.column(k));
    for (int k = 0; k < 3; ++k) {
      t[3 * row + k] = t_row[k];
      s[3 * row + k] = 0;
    }
  }
  subtract_lifted(t, s);
  double product = 0;
  for (int row = 0; row < N_.n_rows(); ++row) {
    const double* p_row = p + 3 * row;
    const double* t_row = t + 3 * row;
    double rest[3];
    multiply_packed(remainders_.data() + row * kPackedSize, t_row, rest);
    for (int k = 0; k < 3; ++k) rest[k] += p_row[k] + s[3 * row + k];
    for (int k = N_.begin(row); k < N_.begin(row + 1); ++k)
      subtract_product(N_.block(k), s + 3 * N_.column(k), rest);
    double s_row[3];
    multiply_packed(inverse(row), rest, s_row);
    for (int k = 0; k < 3; ++k) {
      s[3 * row + k] = s_row[k];
      product += p_row[k] * (t_row[k] + s_row[k]);
    }
  }
  return product;
}

}  // namespace pleat
