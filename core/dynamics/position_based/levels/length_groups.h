#pragma once

#include <array>
#include <vector>

#include "core/dynamics/method_options.h"
#include "core/dynamics/position_based/lane_operations.h"
#include "core/dynamics/position_based/levels/independent_sets.h"
#include "core/dynamics/position_based/levels/mean_correction.h"

namespace pleat {

/// A length that two places keep.
struct PlaceLength {
  PlacePair places;
  double length;  ///< [m]
};

/// The side of its length on which a constraint acts.
enum class LengthSide {
  both,
  longer,  ///< places may come nearer: folded cloth has shorter chords
};

/// A smoother, and by how much more than it asks for each constraint is corrected; 1 where the
/// smoother does not say.
struct Relaxation {
  Smoother smoother = Smoother::gauss_seidel;
  double omega = 1;  ///< sor and jacobi only
};

/// Rigid constraints on lengths between places, four at a time in an order in which no two of four
/// share a place. Every place is four numbers, x y z and one unused, at its start and its move of
/// the substep. The last place is nobody's: lanes without a constraint work on it.
///
/// Quad  Float4, or Double4 for tests
template <class Quad>
class LengthGroups {
 public:
  using Real = typename Quad::Real;

  LengthGroups() = default;
  /// inverse_masses  relative, of each place; 0 where it does not move, as of the last one
  LengthGroups(const std::vector<PlaceLength>& lengths, const std::vector<double>& inverse_masses,
               LengthSide side);

  /// Projects each constraint once, unless the smoother is none; all lengths times `growth`.
  void sweep(const Real* begins, Real* moves, const Relaxation& relaxation, Real growth = 1);

  /// Makes each length what its places are apart now, less a strain. In arrays of strains a length
  /// stands at its place_of.
  void aim_at(const Real* begins, const Real* moves, const Real* strains);
  /// Excess of the places' distances over their lengths, relative to these.
  void strains(const Real* begins, const Real* moves, Real* strains) const;

  int n_lengths() const { return n_lengths_; }
  std::size_t n_strains() const { return 4 * groups_.size(); }
  /// Places of the lengths' strains, in the order in which they were given.
  const std::vector<int>& strain_places() const { return strain_places_; }

 private:
  struct Group {
    std::array<int, 4> a, b;  // first numbers of the places
    std::array<Real, 4> square;
    std::array<Real, 4> w_a, w_b;   // inverse masses
    std::array<Real, 4> inverse_w;  // 1/(w_a + w_b); 0 where nothing moves
  };

  void project(const Real* begins, const Real* moves, Real* to, Real omega, Real growth);

  LengthSide side_ = LengthSide::both;
  int n_lengths_ = 0;
  std::vector<int> strain_places_;
  std::vector<Group> groups_;
  MeanCorrection<Quad> mean_;
};

extern template class LengthGroups<Float4>;

}  // namespace pleat
