#include "core/linalg/iterative/successive_overrelaxation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/linalg/iterative/block_iteration.h"

namespace pleat {
namespace {

constexpr int kLanczosSteps = 40;
constexpr double kExhausted = 1e-10;       // share of a unit vector: no direction is left
constexpr double kLargestRadius = 0.9999;  // limit beyond which so few steps tell little

/// A 3 x 3 block as three columns of four, the last of which is zero: two pairs of a processor's
/// lanes each.
constexpr std::size_t kPaddedColumn = 4;
constexpr std::size_t kPaddedBlock = 3 * kPaddedColumn;

/// y += B x for a padded block and a y of four.
inline void add_product(const double* B, const double* x, double* y) {
  for (std::size_t r = 0; r < kPaddedColumn; ++r)
    y[r] += B[r] * x[0] + B[kPaddedColumn + r] * x[1] + B[2 * kPaddedColumn + r] * x[2];
}

/// Each node takes the first colour that no neighbour has, breadth first: two colours where two are
/// enough.
std::vector<int> coloured(const std::vector<std::vector<int>>& neighbours) {
  std::vector<int> colours(neighbours.size(), -1);
  std::vector<std::size_t> queue;
  std::vector<char> is_taken;
  for (std::size_t first = 0; first < neighbours.size(); ++first) {
    if (colours[first] >= 0) continue;
    colours[first] = 0;
    queue.assign(1, first);
    for (std::size_t at = 0; at < queue.size(); ++at) {
      for (const int next : neighbours[queue[at]]) {
        const auto node = static_cast<std::size_t>(next);
        if (colours[node] >= 0) continue;
        is_taken.assign(neighbours[node].size() + 1, 0);
        for (const int beside : neighbours[node]) {
          const int colour = colours[static_cast<std::size_t>(beside)];
          if (colour >= 0 && colour < static_cast<int>(is_taken.size()))
            is_taken[static_cast<std::size_t>(colour)] = 1;
        }
        colours[node] =
            static_cast<int>(std::find(is_taken.begin(), is_taken.end(), 0) - is_taken.begin());
        queue.push_back(node);
      }
    }
  }
  return colours;
}

/// A symmetric tridiagonal matrix.
class Tridiagonal {
 public:
  /// The next row: its diagonal and what joins it to the row before.
  void add(double on_diagonal, double beside) { rows_.push_back({on_diagonal, beside * beside}); }

  /// The largest size of an eigenvalue, at most kLargestRadius, by bisection.
  double radius() const {
    double low = 0;
    double high = kLargestRadius;
    if (!all_within(high)) return high;
    while (high - low > 1e-3 * (1 - high)) {
      const double middle = low + (high - low) / 2;
      (all_within(middle) ? high : low) = middle;
    }
    return high;
  }

 private:
  struct Row {
    double on_diagonal, squared_beside;
  };

  bool all_within(double size) const {
    return n_below(size) == rows_.size() && n_below(-size) == 0;
  }

  /// How many eigenvalues are below a value: as many as the pivots of the shifted matrix that are
  /// negative (Sylvester).
  std::size_t n_below(double value) const {
    std::size_t count = 0;
    double pivot = 1;
    for (const Row& row : rows_) {
      pivot = row.on_diagonal - value - row.squared_beside / pivot;
      if (pivot == 0) pivot = kTiny;
      count += pivot < 0 ? 1 : 0;
    }
    return count;
  }

  static constexpr double kTiny = 1e-300;

  std::vector<Row> rows_;
};

/// The block rows of a matrix by colour: rows of one colour have no block with each other, so that
/// a sweep need not wait for one to go on with the next. Each row has all of its blocks.
class ColouredRows {
 public:
  void analyze(const SparseMatrix& lower) {
    const std::vector<std::vector<int>> neighbours = block_neighbours(lower);
    const std::vector<int> colours = coloured(neighbours);
    n_colours_ = 1 + *std::max_element(colours.begin(), colours.end());
    rows_.clear();
    others_.clear();
    colour_ends_.clear();
    std::vector<std::size_t> place(neighbours.size());  // place of each row in rows_
    for (int colour = 0; colour < n_colours_; ++colour) {
      for (std::size_t row = 0; row < neighbours.size(); ++row) {
        if (colours[row] != colour) continue;
        place[row] = rows_.size();
        others_.insert(others_.end(), neighbours[row].begin(), neighbours[row].end());
        rows_.push_back({static_cast<int>(row), others_.size()});
      }
      colour_ends_.push_back(rows_.size());
    }
    blocks_.assign((others_.size() + rows_.size()) * kPaddedBlock, 0.0);
    inverses_.assign(rows_.size() * kPaddedBlock, 0.0);
    find_destinations(lower, place);
  }

  /// Takes the values. Returns the first row whose diagonal block is not positive definite, else
  /// -1.
  int set_values(const SparseMatrix& lower) {
    const double* source = lower.valuePtr();
    for (std::size_t k = 0; k < destinations_.size(); ++k)
      for (const std::uint32_t destination : destinations_[k]) blocks_[destination] = source[k];
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const double* D = diagonal(k);
      const double packed[kPackedSize] = {D[0], D[1], D[5], D[2], D[6], D[10]};
      double inverse[kPackedSize];
      if (!invert_packed(packed, inverse)) return rows_[k].row;
      const double columns[3][3] = {{inverse[0], inverse[1], inverse[3]},
                                    {inverse[1], inverse[2], inverse[4]},
                                    {inverse[3], inverse[4], inverse[5]}};
      for (std::size_t c = 0; c < 3; ++c)
        std::copy(columns[c], columns[c] + 3,
                  inverses_.data() + k * kPaddedBlock + c * kPaddedColumn);
    }
    return -1;
  }

  int n_colours() const { return n_colours_; }

  /// x_i += omega (D_i^-1 (b_i - sum_j A_ij x_j) - x_i) for the rows of a colour. Returns the sum
  /// of the squares of these steps.
  double relax(int colour, double omega, const double* b, double* x) const {
    const std::size_t first = colour == 0 ? 0 : colour_ends_[static_cast<std::size_t>(colour - 1)];
    double squares = 0;
    for_each_row(first, colour_ends_[static_cast<std::size_t>(colour)], x,
                 [&](std::size_t k, int row, const double* sum) {
                   const double* own_b = b + 3 * row;
                   double* own_x = x + 3 * row;
                   const double rest[3] = {own_b[0] - sum[0], own_b[1] - sum[1], own_b[2] - sum[2]};
                   double wanted[kPaddedColumn] = {};
                   add_product(inverses_.data() + k * kPaddedBlock, rest, wanted);
                   for (int i = 0; i < 3; ++i) {
                     const double step = omega * (wanted[i] - own_x[i]);
                     squares += step * step;
                     own_x[i] += step;
                   }
                 });
    return squares;
  }

  /// Relaxes the first colour where b - A x is known; returns as relax.
  double relax_first(double omega, const double* rest, double* x) const {
    double squares = 0;
    for (std::size_t k = 0; k < colour_ends_[0]; ++k) {
      const int row = rows_[k].row;
      double step[kPaddedColumn] = {};
      add_product(inverses_.data() + k * kPaddedBlock, rest + 3 * row, step);
      for (int i = 0; i < 3; ++i) {
        squares += omega * omega * step[i] * step[i];
        x[3 * row + i] += omega * step[i];
      }
    }
    return squares;
  }

  /// Sets rest = b - A x and returns its length.
  double residual(const double* b, const double* x, double* rest) const {
    double squares = 0;
    for_each_row(0, rows_.size(), x, [&](std::size_t k, int row, double* sum) {
      add_product(diagonal(k), x + 3 * row, sum);
      for (int i = 0; i < 3; ++i) {
        const double own = b[3 * row + i] - sum[i];
        rest[3 * row + i] = own;
        squares += own * own;
      }
    });
    return std::sqrt(squares);
  }

  /// An estimate of the spectral radius of block Jacobi's iteration x -> -D^-1 (A - D) x, which is
  /// self-adjoint in the metric of D: Lanczos' steps come to it from below. Changes x.
  double jacobi_radius(std::vector<double>& x) const {
    Random random(1);
    for (double& value : x) value = random.uniform(-1, 1);
    std::vector<double> before(x.size(), 0.0);
    std::vector<double> next(x.size());
    Tridiagonal projected;
    double length = length_in_metric(x);
    for (int step = 0; step < kLanczosSteps && length > 0; ++step) {
      for (double& value : x) value /= length;
      double on_diagonal = 0;
      for_each_row(0, rows_.size(), x.data(), [&](std::size_t k, int row, const double* sum) {
        double moved[kPaddedColumn] = {};
        add_product(inverses_.data() + k * kPaddedBlock, sum, moved);
        for (int i = 0; i < 3; ++i) {
          on_diagonal -= x[static_cast<std::size_t>(3 * row + i)] * sum[i];
          next[static_cast<std::size_t>(3 * row + i)] = -moved[i];
        }
      });
      const double to_before = step == 0 ? 0 : length;
      projected.add(on_diagonal, to_before);
      for (std::size_t k = 0; k < x.size(); ++k)
        next[k] -= on_diagonal * x[k] + to_before * before[k];
      before.swap(x);
      x.swap(next);
      length = length_in_metric(x);
      if (length < kExhausted) break;
    }
    return projected.radius();
  }

 private:
  /// The root of x'D x.
  double length_in_metric(const std::vector<double>& x) const {
    double square = 0;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const double* own = x.data() + 3 * rows_[k].row;
      double product[kPaddedColumn] = {};
      add_product(diagonal(k), own, product);
      for (int i = 0; i < 3; ++i) square += own[i] * product[i];
    }
    return std::sqrt(square);
  }

  struct Row {
    int row;
    std::size_t blocks_end;  // end of its blocks in others_
  };

  const double* diagonal(std::size_t k) const {
    return blocks_.data() + (others_.size() + k) * kPaddedBlock;
  }

  /// The places of an entry in blocks_: below and above the diagonal.
  void find_destinations(const SparseMatrix& lower, const std::vector<std::size_t>& place) {
    const auto padded = [&](std::size_t row, int other, std::size_t r, std::size_t c) {
      const std::size_t k = place[row];
      std::size_t block = others_.size() + k;
      if (other != static_cast<int>(row)) {
        const auto begin =
            others_.begin() + static_cast<std::ptrdiff_t>(k == 0 ? 0 : rows_[k - 1].blocks_end);
        const auto end = others_.begin() + static_cast<std::ptrdiff_t>(rows_[k].blocks_end);
        block = static_cast<std::size_t>(std::lower_bound(begin, end, other) - others_.begin());
      }
      return static_cast<std::uint32_t>(block * kPaddedBlock + c * kPaddedColumn + r);
    };
    destinations_.clear();
    destinations_.reserve(static_cast<std::size_t>(lower.nonZeros()));
    for (Eigen::Index column = 0; column < lower.cols(); ++column) {
      for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
        const auto [i, r] = std::div(static_cast<int>(entry.row()), 3);
        const auto [j, c] = std::div(static_cast<int>(column), 3);
        destinations_.push_back({padded(static_cast<std::size_t>(i), j, static_cast<std::size_t>(r),
                                        static_cast<std::size_t>(c)),
                                 padded(static_cast<std::size_t>(j), i, static_cast<std::size_t>(c),
                                        static_cast<std::size_t>(r))});
      }
    }
  }

  /// act(k, row, sum) with the sum of A_ij x_j over the other rows, for rows_ from begin to end.
  template <class Action>
  void for_each_row(std::size_t begin, std::size_t end, const double* x, Action&& act) const {
    std::size_t j = begin == 0 ? 0 : rows_[begin - 1].blocks_end;
    for (std::size_t k = begin; k < end; ++k) {
      double sum[kPaddedColumn] = {};
      for (; j < rows_[k].blocks_end; ++j)
        add_product(blocks_.data() + j * kPaddedBlock, x + 3 * others_[j], sum);
      act(k, rows_[k].row, sum);
    }
  }

  int n_colours_ = 0;
  std::vector<Row> rows_;                 // rows ordered by colour
  std::vector<std::size_t> colour_ends_;  // ends of the colours in rows_
  std::vector<int> others_;               // the column of each block, row by row
  std::vector<double> blocks_;            // padded; then those on the diagonal
  std::vector<double> inverses_;          // padded inverses of those on the diagonal
  // Places of each entry of the sparse matrix; half as wide, so that more else stays cached.
  std::vector<std::array<std::uint32_t, 2>> destinations_;
};

/// The factors of the sweeps to come, colour by colour. With two colours and a known radius they
/// rise from 1 as Chebyshev's polynomials have it.
class Omega {
 public:
  Omega(double given, double radius, int n_colours) : omega_(given), square_(radius * radius) {
    if (given > 0) return;
    rises_ = n_colours == 2;
    omega_ = rises_ ? 1 : 2 / (1 + std::sqrt(1 - square_));
  }

  double next() {
    const double now = omega_;
    if (rises_) omega_ = 1 / (1 - square_ * (is_first_ ? 0.5 : omega_ / 4));
    is_first_ = false;
    return now;
  }

 private:
  double omega_, square_;
  bool rises_ = false;
  bool is_first_ = true;
};

class SuccessiveOverrelaxation final : public BlockIteration {
 public:
  explicit SuccessiveOverrelaxation(const SolverOptions& options) : BlockIteration(options) {}

  void do_analyze(const SparseMatrix& lower) override {
    rows_.analyze(lower);
    radius_ = -1;
  }

  SolveReport do_factorize(const SparseMatrix& lower) override {
    const int row = rows_.set_values(lower);
    if (row >= 0)
      return {SolveStatus::not_positive_definite, 0, 0,
              "diagonal block of row " + std::to_string(3 * row) + " is not positive definite"};
    if (options_.omega == 0 && radius_ < 0) {
      x_.resize(static_cast<std::size_t>(lower.rows()));
      radius_ = rows_.jacobi_radius(x_);
    }
    return {};
  }

 private:
  SolveReport solve_column(double b_norm) override {
    rest_.resize(b_.size());
    double residual = rows_.residual(b_.data(), x_.data(), rest_.data());
    if (!(residual <= b_norm)) {
      std::fill(x_.begin(), x_.end(), 0.0);
      rest_ = b_;
      residual = b_norm;
    }
    bool is_rest_known = true;
    const double goal = options_.tolerance * b_norm;
    Omega omega(options_.omega, radius_, rows_.n_colours());
    SolveReport report;
    while (!(residual <= goal)) {
      if (report.iterations == options_.max_iterations) {
        report.status = SolveStatus::not_converged;
        report.message = "the iteration cap was reached";
        break;
      }
      double squares = is_rest_known ? rows_.relax_first(omega.next(), rest_.data(), x_.data())
                                     : rows_.relax(0, omega.next(), b_.data(), x_.data());
      is_rest_known = false;
      for (int colour = 1; colour < rows_.n_colours(); ++colour)
        squares += rows_.relax(colour, omega.next(), b_.data(), x_.data());
      ++report.iterations;
      const double step = std::sqrt(squares);
      if (!std::isfinite(step))
        return {SolveStatus::not_finite, report.iterations, 0, "a sweep is not finite"};
      // A residual takes a sweep's work, of which the next saves some: it is looked at when it
      // should be at the goal, were it to the step as it was last.
      const bool is_last = report.iterations == options_.max_iterations;
      if (residual_per_step_ * step > goal && !is_last) continue;
      residual = rows_.residual(b_.data(), x_.data(), rest_.data());
      is_rest_known = true;
      residual_per_step_ = residual / step;
    }
    report.relative_residual = residual / b_norm;
    return report;
  }

  ColouredRows rows_;
  std::vector<double> rest_;  // b - A x, when last looked at
  double radius_ = -1;  // spectral radius of block Jacobi's iteration, -1 while it is not known
  double residual_per_step_ = 0;  // ratio when both were last known
};

}  // namespace

std::unique_ptr<LinearSolver> make_successive_overrelaxation(const SolverOptions& options) {
  options.validate();
  return std::make_unique<SuccessiveOverrelaxation>(options);
}

}  // namespace pleat
