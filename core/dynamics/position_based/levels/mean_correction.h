#pragma once

#include <cstddef>
#include <vector>

namespace pleat {

/// The mean of what constraints ask of each place, all from the same places. Places are four
/// numbers each.
template <class Quad>
class MeanCorrection {
 public:
  using Real = typename Quad::Real;

  explicit MeanCorrection(std::size_t n_places = 0) : shares_(n_places, 0) {}

  /// One more constraint acts on a place. Call it before the first `begin`.
  void count(int place) { ++shares_[static_cast<std::size_t>(place)]; }

  /// Sums of corrections, all zero. Allocates once.
  Real* begin() {
    sums_.assign(4 * shares_.size(), 0);
    return sums_.data();
  }

  /// Moves every place by omega times the mean.
  void add_to(Real* moves, Real omega) const {
    for (std::size_t place = 0; place < shares_.size(); ++place) {
      if (shares_[place] == 0) continue;
      Real* const move = moves + 4 * place;
      (Quad::load(move) + Quad::all(omega / shares_[place]) * Quad::load(&sums_[4 * place]))
          .store(move);
    }
  }

 private:
  std::vector<Real> shares_;  // how many constraints act on a place
  std::vector<Real> sums_;
};

}  // namespace pleat
