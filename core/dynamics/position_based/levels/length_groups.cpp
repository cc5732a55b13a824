#include "core/dynamics/position_based/levels/length_groups.h"

#include <limits>

#include "core/base/check.h"
#include "core/base/simd.h"
#include "core/dynamics/position_based/levels/quad_vectors.h"
#include "core/dynamics/position_based/spring_law.h"

namespace pleat {

template <class Quad>
LengthGroups<Quad>::LengthGroups(const std::vector<PlaceLength>& lengths,
                                 const std::vector<double>& inverse_masses, LengthSide side)
    : side_(side), n_lengths_(static_cast<int>(lengths.size())), mean_(inverse_masses.size()) {
  PLEAT_CHECK(inverse_masses.empty() || inverse_masses.back() == 0, "the last place is nobody's");
  const int nobody = static_cast<int>(inverse_masses.size()) - 1;
  std::vector<PlacePair> pairs;
  pairs.reserve(lengths.size());
  for (const PlaceLength& length : lengths) pairs.push_back(length.places);
  std::vector<bool> moves(inverse_masses.size());
  for (std::size_t i = 0; i < moves.size(); ++i) moves[i] = inverse_masses[i] > 0;
  strain_places_.resize(lengths.size());
  for (const std::vector<int>& set : independent_sets(pairs, moves)) {
    for (std::size_t i = 0; i < set.size(); ++i) {
      const std::size_t lane = i % 4;
      if (lane == 0) {
        groups_.emplace_back();
        groups_.back().a.fill(4 * nobody);
        groups_.back().b.fill(4 * nobody);
        groups_.back().square.fill(1);
      }
      const auto& [places, length] = lengths[static_cast<std::size_t>(set[i])];
      const double w_a = inverse_masses[static_cast<std::size_t>(places[0])];
      const double w_b = inverse_masses[static_cast<std::size_t>(places[1])];
      Group& group = groups_.back();
      strain_places_[static_cast<std::size_t>(set[i])] =
          static_cast<int>(4 * (groups_.size() - 1) + lane);
      for (const int place : places) mean_.count(place);
      group.a[lane] = 4 * places[0];
      group.b[lane] = 4 * places[1];
      group.square[lane] = static_cast<Real>(length * length);
      group.w_a[lane] = static_cast<Real>(w_a);
      group.w_b[lane] = static_cast<Real>(w_b);
      group.inverse_w[lane] = static_cast<Real>(w_a + w_b > 0 ? 1 / (w_a + w_b) : 0);
    }
  }
}

// The rigid law of springs (core/dynamics/position_based/spring_law.h): with d at the end and g
// = d + d_begin, (l^2 - L^2)/2 + f (w_a + w_b) d.g = 0, the slope d.g held above L^2 and l^2. Where
// a length holds from above only, aims above zero, which push, are cut off.
template <class Quad>
void LengthGroups<Quad>::project(const Real* begins, const Real* moves, Real* to, Real omega,
                                 Real growth) {
  const Quad most =
      Quad::all(side_ == LengthSide::longer ? Real(0) : std::numeric_limits<Real>::max());
  const Quad half = Quad::all(omega / 2);
  const Quad squared_growth = Quad::all(growth * growth);
  for (const Group& group : groups_) {
    const QuadVectors<Quad> d_begin = gather<Quad>(begins, group.a) - gather<Quad>(begins, group.b);
    const QuadVectors<Quad> d =
        d_begin + (gather<Quad>(moves, group.a) - gather<Quad>(moves, group.b));
    const QuadVectors<Quad> g = d + d_begin;
    const Quad square = dots(d, d);
    const Quad rest = squared_growth * Quad::load(group.square.data());
    const Quad aim = min(half * (rest - square), most);
    const Quad slope = max(dots(d, g), max(rest, square));
    const Quad f = aim / slope * Quad::load(group.inverse_w.data());
    scatter(gather<Quad>(to, group.a) + scaled(g, f * Quad::load(group.w_a.data())), to, group.a);
    scatter(gather<Quad>(to, group.b) - scaled(g, f * Quad::load(group.w_b.data())), to, group.b);
  }
}

template <class Quad>
void LengthGroups<Quad>::sweep(const Real* begins, Real* moves, const Relaxation& relaxation,
                               Real growth) {
  if (relaxation.smoother == Smoother::none) return;
  const auto omega = static_cast<Real>(relaxation.omega);
  const bool is_averaged = relaxation.smoother == Smoother::jacobi;
  project(begins, moves, is_averaged ? mean_.begin() : moves,
          relaxation.smoother == Smoother::sor ? omega : 1, growth);
  if (is_averaged) mean_.add_to(moves, omega);
}

// A length that is too long by e of itself comes back over 1 + e. Times 1 - e is the same for small
// e, but below zero where e is large; one that is too short, e < 0, is stretched by that.
template <class Quad>
void LengthGroups<Quad>::aim_at(const Real* begins, const Real* moves, const Real* strains) {
  const Quad zero = Quad::all(0);
  for (Group& group : groups_) {
    const QuadVectors<Quad> d = gather<Quad>(begins, group.a) - gather<Quad>(begins, group.b) +
                                (gather<Quad>(moves, group.a) - gather<Quad>(moves, group.b));
    const Quad strain = Quad::load(strains);
    const Quad share = (Quad::all(1) - min(strain, zero)) / (Quad::all(1) + max(strain, zero));
    (share * share * dots(d, d)).store(group.square.data());
    strains += 4;
  }
}

template <class Quad>
void LengthGroups<Quad>::strains(const Real* begins, const Real* moves, Real* strains) const {
  const Quad tiny = Quad::all(Real(kTinySquare));
  for (const Group& group : groups_) {
    const QuadVectors<Quad> d = gather<Quad>(begins, group.a) - gather<Quad>(begins, group.b) +
                                (gather<Quad>(moves, group.a) - gather<Quad>(moves, group.b));
    const Quad rest = sqrt(Quad::load(group.square.data()));
    ((sqrt(dots(d, d)) - rest) / max(rest, tiny)).store(strains);
    strains += 4;
  }
}

template class LengthGroups<Float4>;
template class LengthGroups<Double4>;

}  // namespace pleat
