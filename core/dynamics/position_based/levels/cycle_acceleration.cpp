#include "core/dynamics/position_based/levels/cycle_acceleration.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/base/simd.h"

namespace pleat {
namespace {

constexpr std::size_t kStrip = 512;  // numbers that are added up in single precision

double squared_norm(std::span<const float> numbers) {
  double sum = 0;
  for (std::size_t begin = 0; begin < numbers.size(); begin += kStrip) {
    const std::size_t end = std::min(begin + kStrip, numbers.size());
    Float4 strip = Float4::all(0);
    for (std::size_t i = begin; i < end; i += 4) {
      const Float4 number = Float4::load(&numbers[i]);
      strip = strip + number * number;
    }
    sum += sum_of_lanes<double>(strip);
  }
  return sum;
}

constexpr int kDifferences = static_cast<int>(CycleAcceleration::kWindow);
using KnownArrays = std::array<const float*, CycleAcceleration::kWindow>;

/// d_i.d_j of the differences d_i = known_i - last, and d_i.last, in the column behind them.
using Products = Eigen::Matrix<double, kDifferences, kDifferences + 1>;

Products products(const KnownArrays& known, std::span<const float> last) {
  constexpr std::size_t kCount = kDifferences;
  Products sums = Products::Zero();
  for (std::size_t begin = 0; begin < last.size(); begin += kStrip) {
    const std::size_t end = std::min(begin + kStrip, last.size());
    std::array<std::array<Float4, kCount + 1>, kCount> strip;
    for (auto& row : strip) row.fill(Float4::all(0));
    for (std::size_t k = begin; k < end; k += 4) {
      std::array<Float4, kCount + 1> d;
      d[kCount] = Float4::load(&last[k]);
      for (std::size_t i = 0; i < kCount; ++i) d[i] = Float4::load(known[i] + k) - d[kCount];
      for (std::size_t i = 0; i < kCount; ++i)
        for (std::size_t j = i; j <= kCount; ++j) strip[i][j] = strip[i][j] + d[i] * d[j];
    }
    for (std::size_t i = 0; i < kCount; ++i)
      for (std::size_t j = i; j <= kCount; ++j)
        sums(static_cast<int>(i), static_cast<int>(j)) += sum_of_lanes<double>(strip[i][j]);
  }
  return sums;
}

/// a of the least |last + sum of a_i d_i|.
std::array<float, kDifferences> least_errors(const KnownArrays& known,
                                             std::span<const float> last) {
  // Share of the mean of d_i.d_i: less of a difference, beside those before it, is rounding or its
  // turn in the cycles since.
  constexpr double kLost = 1e-6;
  const Products sums = products(known, last);
  Eigen::Matrix<double, kDifferences, kDifferences> normal =
      sums.leftCols<kDifferences>().selfadjointView<Eigen::Upper>();
  normal.diagonal().array() += kLost * normal.trace() / kDifferences;
  const Eigen::Matrix<double, kDifferences, 1> a = normal.llt().solve(-sums.col(kDifferences));
  std::array<float, kDifferences> weights{};
  if (a.allFinite())
    for (std::size_t i = 0; i < weights.size(); ++i)
      weights[i] = static_cast<float>(a[static_cast<int>(i)]);
  return weights;
}

void copy(CycleAcceleration::Arrays from, std::vector<float>& to) {
  to.clear();
  for (const std::span<float>& array : from) to.insert(to.end(), array.begin(), array.end());
}

/// Adds sum of a_i (known_i - last) to the arrays, which are `last`.
void add(const std::array<float, kDifferences>& weights, const KnownArrays& known,
         CycleAcceleration::Arrays arrays) {
  std::size_t first = 0;
  for (const std::span<float>& array : arrays) {
    for (std::size_t k = 0; k < array.size(); k += 4) {
      const Float4 last = Float4::load(&array[k]);
      Float4 sum = last;
      for (std::size_t i = 0; i < known.size(); ++i)
        sum = sum + Float4::all(weights[i]) * (Float4::load(known[i] + first + k) - last);
      sum.store(&array[k]);
    }
    first += array.size();
  }
}

}  // namespace

bool CycleAcceleration::propose(Arrays point, std::span<const float> errors) {
  copy(point, image_.point);
  image_.errors.assign(errors.begin(), errors.end());
  image_square_ = squared_norm(errors);
  if (n_known_ == 0) return false;
  // Points that are not known yet are no different from the last.
  std::array<const float*, kWindow> of_points, of_errors;
  for (std::size_t i = 0; i < kWindow; ++i) {
    const Known& known = i < n_known_ ? known_[i] : image_;
    of_points[i] = known.point.data();
    of_errors[i] = known.errors.data();
  }
  add(least_errors(of_errors, errors), of_points, point);
  return true;
}

void CycleAcceleration::settle(Arrays point, std::span<float> errors) {
  const double square = squared_norm(errors);
  if (!(square <= image_square_)) {
    auto from = image_.point.begin();
    for (const std::span<float>& array : point) {
      std::copy_n(from, array.size(), array.begin());
      from += static_cast<std::ptrdiff_t>(array.size());
    }
    std::copy(image_.errors.begin(), image_.errors.end(), errors.begin());
    n_known_ = 0;
  }
  if (n_known_ == 0) next_ = 0;
  Known& known = known_[next_];
  copy(point, known.point);
  known.errors.assign(errors.begin(), errors.end());
  next_ = (next_ + 1) % kWindow;
  n_known_ = std::min(n_known_ + 1, kWindow);
}

}  // namespace pleat
