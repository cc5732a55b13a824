#include "core/dynamics/position_based/lanes/bend_program.h"

namespace pleat {
namespace {

constexpr int kLanesOfSet = Float4::kLanes;
/// Sets side by side whose groups fill a line of the cache.
constexpr int kSetsTogether = 4;
constexpr int kMultiplierFloats = 3 * kLanesOfSet;
/// Places of the vertices of four threads, one after the other.
template <class Lanes, bool in_groups>
struct ThreadSlots {
  const int* slots;
  int lane;

  Lanes load(const float* array, int place) const {
    if constexpr (in_groups) {
      return Lanes::load(array + slots[place] + lane);
    } else if constexpr (Lanes::kLanes == 1) {
      return {array[slots[kLanesOfSet * place + lane]]};
    } else {
      const int* const at = slots + kLanesOfSet * place;
      return Lanes::gather(array, {at[0], at[1], at[2], at[3]});
    }
  }
  void store(Lanes value, float* array, int place) const {
    if constexpr (in_groups) {
      value.store(array + slots[place] + lane);
    } else if constexpr (Lanes::kLanes == 1) {
      array[slots[kLanesOfSet * place + lane]] = value.value;
    } else {
      const int* const at = slots + kLanesOfSet * place;
      value.scatter(array, {at[0], at[1], at[2], at[3]});
    }
  }
  template <class Pointer>
  Vec3Lanes<Lanes> load(const std::array<Pointer, 3>& arrays, int place) const {
    return {load(arrays[0], place), load(arrays[1], place), load(arrays[2], place)};
  }
  void store(const Vec3Lanes<Lanes>& value, const std::array<float*, 3>& arrays, int place) const {
    store(value.x, arrays[0], place);
    store(value.y, arrays[1], place);
    store(value.z, arrays[2], place);
  }
};

template <class Lanes>
Vec3Lanes<Lanes> three_at(const float* from) {
  return {Lanes::load(from), Lanes::load(from + kLanesOfSet), Lanes::load(from + 2 * kLanesOfSet)};
}
template <class Lanes>
void store_three(const Vec3Lanes<Lanes>& value, float* to) {
  value.x.store(to);
  value.y.store(to + kLanesOfSet);
  value.z.store(to + 2 * kLanesOfSet);
}
template <bool first, class Lanes>
void add_three(const Vec3Lanes<Lanes>& change, float* multipliers) {
  add_to_multiplier<first>(change.x, multipliers);
  add_to_multiplier<first>(change.y, multipliers + kLanesOfSet);
  add_to_multiplier<first>(change.z, multipliers + 2 * kLanesOfSet);
}

}  // namespace

BendProgram::BendProgram(const ClothModel& model, const LaneLayout& layout, double h)
    : chains_(bend_chains(model, bend_constraints(model, h))), sets_(bend_sets(chains_, layout)) {
  int n_places = 0;
  int longest = 0;
  for (const BendSet& set : sets_.sets) {
    n_places += set.n_bends;
    longest = std::max(longest, set.n_bends);
  }
  multipliers_.resize(static_cast<std::size_t>(n_places * kMultiplierFloats));
  const int n_scratch = std::max(kSetsTogether * (longest + 2), layout.row_slots());
  scratch_.resize(static_cast<std::size_t>(n_scratch * kMultiplierFloats));
}

std::vector<BendProgram::Place> BendProgram::make_places(const BendSet& set,
                                                         const float* inverse_masses) const {
  std::vector<Place> places(static_cast<std::size_t>(set.n_bends + 2));
  for (std::size_t lane = 0; lane < kLanesOfSet; ++lane) {
    if (set.chains[lane] < 0) continue;
    const BendChain& chain = chains_[static_cast<std::size_t>(set.chains[lane])];
    std::vector<double> of_vertices;
    for (std::size_t v = 0; v < chain.vertices.size(); ++v) {
      const std::size_t at =
          static_cast<std::size_t>(set.first_slot) + (set.in_groups ? v : kLanesOfSet * v + lane);
      places[v].inverse_mass[lane] =
          inverse_masses[sets_.slots[at] + (set.in_groups ? static_cast<int>(lane) : 0)];
      of_vertices.push_back(places[v].inverse_mass[lane]);
    }
    const BendChainFactor factor = bend_chain_factor(chain, of_vertices);
    for (std::size_t i = 0; i < chain.bends.size(); ++i) {
      Place& place = places[i];
      place.before[lane] = chain.bends[i].before;
      place.middle[lane] = chain.bends[i].before + chain.bends[i].after;
      place.after[lane] = chain.bends[i].after;
      place.compliance[lane] = chain.bends[i].compliance;
      place.next_but_one[lane] = static_cast<float>(factor.rows[i].next_but_one);
      place.next[lane] = static_cast<float>(factor.rows[i].next);
      place.inverse_pivot[lane] = static_cast<float>(factor.rows[i].inverse_pivot);
    }
  }
  return places;
}

// Threads of a regular sheet have equal numbers, but for some near borders and pins, and then those
// of the whole sheet stay in the nearest cache.
void BendProgram::refresh_pins(const float* inverse_masses) {
  constexpr std::size_t kRemembered = 8;
  std::vector<const BendSet*> different;
  places_.clear();
  for (BendSet& set : sets_.sets) {
    const std::vector<Place> places = make_places(set, inverse_masses);
    const auto same = std::find_if(different.begin(), different.end(), [&](const BendSet* known) {
      return known->n_bends == set.n_bends &&
             std::equal(places.begin(), places.end(), places_.begin() + known->first_place);
    });
    if (same != different.end()) {
      set.first_place = (*same)->first_place;
      continue;
    }
    set.first_place = static_cast<int>(places_.size());
    places_.insert(places_.end(), places.begin(), places.end());
    if (different.size() < kRemembered) different.push_back(&set);
  }
}

// With C_i = after_i e_(i+2) - before_i e_(i+1) of the edges e_j = x_j - x_(j-1), the changes of a
// thread's multipliers solve
//   (J W J^T + alpha) dlambda = -(C + alpha lambda),
// by L z = right-hand side on the way out, L^T dlambda = D^-1 z on the way back, where the vertex
// two places on gets the last of its three shares of W J^T dlambda. x, y and z alike.
template <class Lanes, Multipliers use, class EdgeTo>
void BendProgram::eliminate(const BendSet& set, int lane, float* scratch, const EdgeTo& edge_to) {
  const Place* const places = places_of(set);
  const float* const multipliers = multipliers_.data() + set.first_multiplier + lane;
  const auto of = [lane](const PerLane<float>& numbers) {
    return Lanes::load(numbers.data() + lane);
  };
  const Lanes zero = Lanes::all(0);
  Vec3Lanes<Lanes> edge = edge_to(1);
  Vec3Lanes<Lanes> z_1{zero, zero, zero};  // the place before has it
  Vec3Lanes<Lanes> z_2 = z_1;              // the one before that
  for (int i = 0; i < set.n_bends; ++i) {
    const Place& place = places[i];
    const Vec3Lanes<Lanes> edge_after = edge_to(i + 2);
    Vec3Lanes<Lanes> z = of(place.before) * edge - of(place.after) * edge_after;
    if constexpr (use == Multipliers::kept)
      z = z - of(place.compliance) * three_at<Lanes>(multipliers + kMultiplierFloats * i);
    z = (z - of(place.next_but_one) * z_2) - of(place.next) * z_1;
    store_three(of(place.inverse_pivot) * z, scratch + kMultiplierFloats * i);
    z_2 = z_1;
    z_1 = z;
    edge = edge_after;
  }
}

/// move_by(place, how far to move the vertex there)
template <class Lanes, Multipliers use, class MoveBy>
void BendProgram::substitute(const BendSet& set, int lane, const float* scratch,
                             const MoveBy& move_by) {
  const Place* const places = places_of(set);
  float* const multipliers = multipliers_.data() + set.first_multiplier + lane;
  const auto of = [lane](const PerLane<float>& numbers) {
    return Lanes::load(numbers.data() + lane);
  };
  const Lanes zero = Lanes::all(0);
  Vec3Lanes<Lanes> change_1{zero, zero, zero};  // the place after has it
  Vec3Lanes<Lanes> change_2 = change_1;         // the one after that
  for (int i = set.n_bends - 1; i >= 0; --i) {
    const Place& place = places[i];
    const Place& place_1 = places[i + 1];
    const Place& place_2 = places[i + 2];
    const Vec3Lanes<Lanes> change =
        (three_at<Lanes>(scratch + kMultiplierFloats * i) - of(place_2.next_but_one) * change_2) -
        of(place_1.next) * change_1;
    if constexpr (use != Multipliers::passing)
      add_three<use == Multipliers::begun>(change, multipliers + kMultiplierFloats * i);
    move_by(i + 2,
            of(place_2.inverse_mass) * ((of(place.after) * change - of(place_1.middle) * change_1) +
                                        of(place_2.before) * change_2));
    change_2 = change_1;
    change_1 = change;
  }
  move_by(1, of(places[1].inverse_mass) *
                 (of(places[1].before) * change_2 - of(places[0].middle) * change_1));
  move_by(0, of(places[0].inverse_mass) * (of(places[0].before) * change_1));
}

template <class Lanes, Multipliers use, bool in_groups>
void BendProgram::solve(const LaneView& view, const BendSet& set, int lane) {
  const LaneView v = view;
  const ThreadSlots<Lanes, in_groups> at{sets_.slots.data() + set.first_slot, lane};
  Vec3Lanes<Lanes> begin = at.load(v.begins, 0);
  Vec3Lanes<Lanes> move = at.load(v.moves, 0);
  eliminate<Lanes, use>(set, lane, scratch_.data(), [&](int place) {
    const Vec3Lanes<Lanes> begin_before = begin;
    const Vec3Lanes<Lanes> move_before = move;
    begin = at.load(v.begins, place);
    move = at.load(v.moves, place);
    return (begin - begin_before) + (move - move_before);
  });
  substitute<Lanes, use>(set, lane, scratch_.data(), [&](int place, const Vec3Lanes<Lanes>& by) {
    at.store(at.load(v.moves, place) + by, v.moves, place);
  });
}

// Row by row for sets side by side, so that a line of the cache is used at once; thread by thread
// between.
template <Multipliers use>
void BendProgram::solve_groups(const LaneView& view, const BendSet* sets, int n_sets) {
  const LaneView v = view;
  const int* const slots = sets_.slots.data() + sets->first_slot;
  const int n_places = sets->n_bends + 2;
  const auto scratch_of = [&](int set, int place) {
    return scratch_.data() + kMultiplierFloats * (set * n_places + place);
  };
  for (int place = 1; place < n_places; ++place)
    for (int set = 0; set < n_sets; ++set) {
      const int here = slots[place] + kLanesOfSet * set;
      const int before = slots[place - 1] + kLanesOfSet * set;
      store_three((load<Float4>(v.begins, here) - load<Float4>(v.begins, before)) +
                      (load<Float4>(v.moves, here) - load<Float4>(v.moves, before)),
                  scratch_of(set, place));
    }
  for (int set = 0; set < n_sets; ++set) {
    float* const scratch = scratch_of(set, 0);
    eliminate<Float4, use>(sets[set], 0, scratch, [=](int place) {
      return three_at<Float4>(scratch + kMultiplierFloats * place);
    });
    substitute<Float4, use>(sets[set], 0, scratch, [=](int place, const Vec3Lanes<Float4>& by) {
      store_three(by, scratch + kMultiplierFloats * place);
    });
  }
  for (int place = 0; place < n_places; ++place)
    for (int set = 0; set < n_sets; ++set) {
      const int here = slots[place] + kLanesOfSet * set;
      store(load<Float4>(v.moves, here) + three_at<Float4>(scratch_of(set, place)), v.moves, here);
    }
}

// Four rows at once: what is in four pieces of a row, for four rows, is turned into four places of
// four rows, and back.
template <Multipliers use>
void BendProgram::solve_rows(const LaneView& view, const BendSet& set) {
  const LaneView v = view;
  std::array<int, kLanesOfSet> rows;
  for (std::size_t row = 0; row < rows.size(); ++row)  // the first, unmoved, stands for none
    rows[row] =
        sets_.slots[static_cast<std::size_t>(set.first_slot) + (set.chains[row] < 0 ? 0 : row)];
  const int stride = set.stride;
  float* const scratch = scratch_.data();
  const auto scratch_of = [=](int group, int piece, int component) {
    return scratch + kMultiplierFloats * (group + piece * stride) + kLanesOfSet * component;
  };
  for (int group = 0; group < stride; ++group) {
    // The last group, one float further on, holds the ends of the pieces before.
    const int before = group > 0 ? kLanesOfSet * (group - 1) : kLanesOfSet * (stride - 1) - 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto edges = [&](int row) {
        const float* const begin = v.begins[k] + row;
        const float* const move = v.moves[k] + row;
        const int here = kLanesOfSet * group;
        return (Float4::load(begin + here) - Float4::load(begin + before)) +
               (Float4::load(move + here) - Float4::load(move + before));
      };
      Float4 a = edges(rows[0]);
      Float4 b = edges(rows[1]);
      Float4 c = edges(rows[2]);
      Float4 d = edges(rows[3]);
      transpose(a, b, c, d);
      const int component = static_cast<int>(k);
      a.store(scratch_of(group, 0, component));
      b.store(scratch_of(group, 1, component));
      c.store(scratch_of(group, 2, component));
      d.store(scratch_of(group, 3, component));
    }
  }
  eliminate<Float4, use>(set, 0, scratch, [=](int place) {
    return three_at<Float4>(scratch + kMultiplierFloats * place);
  });
  substitute<Float4, use>(set, 0, scratch, [=](int place, const Vec3Lanes<Float4>& by) {
    store_three(by, scratch + kMultiplierFloats * place);
  });
  std::fill(scratch + kMultiplierFloats * (set.n_bends + 2),
            scratch + kMultiplierFloats * kLanesOfSet * stride, 0.0f);
  for (int group = 0; group < stride; ++group)
    for (std::size_t k = 0; k < 3; ++k) {
      const int component = static_cast<int>(k);
      Float4 a = Float4::load(scratch_of(group, 0, component));
      Float4 b = Float4::load(scratch_of(group, 1, component));
      Float4 c = Float4::load(scratch_of(group, 2, component));
      Float4 d = Float4::load(scratch_of(group, 3, component));
      transpose(a, b, c, d);
      const auto move_row = [&](int row, Float4 by) {
        float* const move = v.moves[k] + row + kLanesOfSet * group;
        (Float4::load(move) + by).store(move);
      };
      move_row(rows[0], a);
      move_row(rows[1], b);
      move_row(rows[2], c);
      move_row(rows[3], d);
    }
}

template <Multipliers use>
void BendProgram::sweep(const LaneView& view) {
  const std::vector<BendSet>& sets = sets_.sets;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const BendSet& set = sets[i];
    if (is_lane_by_lane_) {
      for (int lane = 0; lane < kLanesOfSet; ++lane)
        if (set.chains[static_cast<std::size_t>(lane)] >= 0)
          set.in_groups ? solve<Float1, use, true>(view, set, lane)
                        : solve<Float1, use, false>(view, set, lane);
    } else if (set.in_groups) {
      solve_groups<use>(view, &set, 1 + set.n_beside);
      i += static_cast<std::size_t>(set.n_beside);
    } else if (set.stride > 0) {
      solve_rows<use>(view, set);
    } else {
      solve<Float4, use, false>(view, set, 0);
    }
  }
}

void BendProgram::sweep(const LaneView& view, Multipliers multipliers) {
  switch (multipliers) {
    case Multipliers::passing:
      return sweep<Multipliers::passing>(view);
    case Multipliers::begun:
      return sweep<Multipliers::begun>(view);
    case Multipliers::kept:
      return sweep<Multipliers::kept>(view);
  }
}

/// visit(x, y and z of the errors of four elements)
template <class Visit>
void BendProgram::visit_errors(const LaneView& v, const Visit& visit) const {
  const auto visit_set = [&](const auto& at, const BendSet& set) {
    const Place* const places = places_of(set);
    const float* multipliers = multipliers_.data() + set.first_multiplier;
    const auto edge_to = [&](int place) {
      return (at.load(v.begins, place) - at.load(v.begins, place - 1)) +
             (at.load(v.moves, place) - at.load(v.moves, place - 1));
    };
    for (int i = 0; i < set.n_bends; ++i) {
      visit(Float4::load(places[i].after.data()) * edge_to(i + 2) -
            Float4::load(places[i].before.data()) * edge_to(i + 1) +
            Float4::load(places[i].compliance.data()) * three_at<Float4>(multipliers));
      multipliers += kMultiplierFloats;
    }
  };
  for (const BendSet& set : sets_.sets) {
    const int* const slots = sets_.slots.data() + set.first_slot;
    if (set.in_groups)
      visit_set(ThreadSlots<Float4, true>{slots, 0}, set);
    else
      visit_set(ThreadSlots<Float4, false>{slots, 0}, set);
  }
}

void BendProgram::errors(const LaneView& view, float unit, float* errors) const {
  const Float4 inverse = Float4::all(1 / unit);
  visit_errors(view, [&](const Vec3Lanes<Float4>& of_four) {
    store_three(inverse * of_four, errors);
    errors += kMultiplierFloats;
  });
}

double BendProgram::squared_residual(const LaneView& view) const {
  Float4 sum = Float4::all(0);
  visit_errors(view, [&](const Vec3Lanes<Float4>& of_four) { sum = sum + dot(of_four, of_four); });
  return sum_of_lanes<double>(sum);
}

}  // namespace pleat
