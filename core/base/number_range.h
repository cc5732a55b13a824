#pragma once

namespace pleat {

/// No quantity of a scene is larger in SI units; squares and products of two stay finite.
constexpr double kLargestNumber = 1e12;

/// Range of numbers that something takes.
struct NumberRange {
  enum class Ends { included, low_excluded, excluded };
  double low = -kLargestNumber;
  double high = kLargestNumber;
  Ends ends = Ends::included;

  constexpr bool contains(double number) const {
    const bool is_above = ends == Ends::included ? number >= low : number > low;
    const bool is_below = ends == Ends::excluded ? number < high : number <= high;
    return is_above && is_below;
  }
};
constexpr NumberRange kAnyNumber{};
constexpr NumberRange kNotNegative{0, kLargestNumber, NumberRange::Ends::included};
constexpr NumberRange kPositive{0, kLargestNumber, NumberRange::Ends::low_excluded};

}  // namespace pleat
