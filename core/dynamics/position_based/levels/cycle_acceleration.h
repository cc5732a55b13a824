#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace pleat {

/// Foretells from the last cycles of a solve where they lead. Of all sums of points, of weights
/// that add up to 1, it proposes the one whose errors would be least if they were linear in the
/// points.
///
/// A point is whatever a cycle changes: moves, and multipliers. What errors a proposal really has
/// is asked for; where they are not less than without, the point stays where the cycle led, and the
/// cycles before it are forgotten. Allocates once.
///
/// Sources: Washio & Oosterlee, Krylov subspace acceleration for nonlinear multigrid schemes,
/// Electronic Transactions on Numerical Analysis 6, 1997. Anderson, Iterative procedures for
/// nonlinear integral equations, Journal of the ACM 1965.
class CycleAcceleration {
 public:
  /// Points that a proposal is made of, beside the last one. Eight save some cycles, and cost three
  /// times as much.
  static constexpr std::size_t kWindow = 4;

  /// Arrays side by side, each of a multiple of four numbers.
  using Arrays = std::span<const std::span<float>>;

  /// Forgets all cycles.
  void begin() { n_known_ = 0; }

  /// Takes the point that a cycle led to, with its errors, a multiple of four, and moves it where
  /// it has a proposal. Returns true then: it is to be settled with the errors there.
  bool propose(Arrays point, std::span<const float> errors);

  /// Takes a proposal that is no better back, and the errors with it. Follows `propose`, with the
  /// errors at the point.
  void settle(Arrays point, std::span<float> errors);

 private:
  struct Known {
    std::vector<float> point, errors;
  };

  std::array<Known, kWindow> known_;
  std::size_t n_known_ = 0;
  std::size_t next_ = 0;     // place in known_ to be forgotten first
  Known image_;              // point that the last cycle led to
  double image_square_ = 0;  // squared norm of its errors
};

}  // namespace pleat
