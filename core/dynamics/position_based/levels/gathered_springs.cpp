#include "core/dynamics/position_based/levels/gathered_springs.h"

#include <limits>

#include "core/dynamics/position_based/levels/quad_vectors.h"

namespace pleat {

GatheredSprings::GatheredSprings(const ClothModel& model, const LaneLayout& layout, SpringLaw law,
                                 double h)
    : law_(law),
      h_(h),
      mean_mass_(model.masses.mean()),
      mean_(static_cast<std::size_t>(layout.n_slots)) {
  const std::vector<int> springs = free_springs(model);
  std::vector<PlacePair> ends;
  for (const int s : springs) {
    const Spring& spring = model.springs[static_cast<std::size_t>(s)];
    ends.push_back({layout.places[static_cast<std::size_t>(spring.a)].slot,
                    layout.places[static_cast<std::size_t>(spring.b)].slot});
  }
  // Pins come and go, so every vertex is taken for one that moves.
  const std::vector<bool> moves(static_cast<std::size_t>(layout.n_slots), true);
  for (const std::vector<int>& set : independent_sets(ends, moves)) {
    for (std::size_t i = 0; i < set.size(); ++i) {
      const std::size_t lane = i % 4;
      if (lane == 0) groups_.push_back({{}, {}, kNoMembers, {}, {}, {}});
      const auto [a, b] = ends[static_cast<std::size_t>(set[i])];
      Group& group = groups_.back();
      group.a[lane] = 4 * a;
      group.b[lane] = 4 * b;
      group.members[lane] = springs[static_cast<std::size_t>(set[i])];
      for (const int slot : {a, b}) mean_.count(slot);
    }
  }
  multipliers_.resize(groups_.size() * Float4::kLanes);
}

void GatheredSprings::refresh_pins(const float* inverse_masses) {
  for (Group& group : groups_)
    for (std::size_t lane = 0; lane < 4; ++lane) {
      if (group.members[lane] < 0) continue;
      group.w_a[lane] = inverse_masses[group.a[lane] / 4];
      group.w_b[lane] = inverse_masses[group.b[lane] / 4];
    }
}

void GatheredSprings::refresh_rest_lengths(const ClothModel& model) {
  for (Group& group : groups_)
    for (std::size_t lane = 0; lane < 4; ++lane)
      if (group.members[lane] >= 0)
        group.block.set_lane(lane, model.springs[static_cast<std::size_t>(group.members[lane])],
                             law_, h_, mean_mass_);
}

// In a page's module each variant of this loop counts: the first sweep is one with multipliers of
// zero, and a mean is gathered where the moves would be changed.
template <SpringLaw law>
void GatheredSprings::project(const float* begins, const float* moves, float* to, float omega) {
  const Float4 relaxation = Float4::all(omega);
  float* multiplier = multipliers_.data();
  for (const Group& group : groups_) {
    const QuadVectors<Float4> change =
        gather<Float4>(moves, group.a) - gather<Float4>(moves, group.b);
    const QuadVectors<Float4> d_begin =
        gather<Float4>(begins, group.a) - gather<Float4>(begins, group.b);
    const Float4 w_a = Float4::load(group.w_a.data());
    const Float4 w_b = Float4::load(group.w_b.data());
    const QuadVectors<Float4> pull = one_by_one(pull_of<Float4, law, false>(
        in_lanes(d_begin), in_lanes(change), w_a + w_b, group.block, 0, multiplier, relaxation));
    scatter(gather<Float4>(to, group.a) + scaled(pull, w_a), to, group.a);
    scatter(gather<Float4>(to, group.b) - scaled(pull, w_b), to, group.b);
    multiplier += Float4::kLanes;
  }
}

void GatheredSprings::sweep(const float* begins, float* moves, const Relaxation& relaxation) {
  const auto omega = static_cast<float>(relaxation.omega);
  const bool is_averaged = relaxation.smoother == Smoother::jacobi;
  float* const to = is_averaged ? mean_.begin() : moves;
  with_law(law_, [&](auto law) {
    project<decltype(law)::value>(begins, moves, to,
                                  relaxation.smoother == Smoother::sor ? omega : 1);
  });
  if (is_averaged) mean_.add_to(moves, omega);
}

std::span<float> GatheredSprings::multipliers() {
  if (is_rigid(law_)) return {};
  return multipliers_;
}

void GatheredSprings::strains(const float* begins, const float* moves, float* strains) const {
  const bool rigid = is_rigid(law_);
  const Float4 tiny = Float4::all(kTinySquare);
  const Float4 largest = Float4::all(std::numeric_limits<float>::max());
  const float* multiplier = multipliers_.data();
  for (const Group& group : groups_) {
    const auto d_begin = gather<Float4>(begins, group.a) - gather<Float4>(begins, group.b);
    const auto d = d_begin + (gather<Float4>(moves, group.a) - gather<Float4>(moves, group.b));
    const Float4 kept = Float4::load(group.block.rest.data());
    const Float4 rest = rigid ? sqrt(kept) : kept;
    Float4 error = sqrt(dots(d, d)) - rest;
    if (!rigid)
      error = error + Float4::load(group.block.compliance.data()) * Float4::load(multiplier);
    const Float4 occupied = largest - Float4::load(group.block.denominator_share.data());
    where_positive(occupied, error / max(rest, tiny)).store(strains);
    strains += 4;
    multiplier += Float4::kLanes;
  }
}

StrainedEdges GatheredSprings::strained_edges(const ClothModel& model) const {
  StrainedEdges edges;
  int place = 0;
  for (const Group& group : groups_)
    for (const int s : group.members) {
      if (s >= 0) {
        const Spring& spring = model.springs[static_cast<std::size_t>(s)];
        edges.ends.push_back({spring.a, spring.b});
        edges.places.push_back(place);
      }
      ++place;
    }
  return edges;
}

double GatheredSprings::squared_residual(const float* begins, const float* moves) const {
  return with_law(law_, [&](auto constant) {
    constexpr SpringLaw kLaw = decltype(constant)::value;
    Float4 sum = Float4::all(0);
    const float* multiplier = multipliers_.data();
    for (const Group& group : groups_) {
      const auto d_begin = gather<Float4>(begins, group.a) - gather<Float4>(begins, group.b);
      const auto change = gather<Float4>(moves, group.a) - gather<Float4>(moves, group.b);
      sum = sum + squared_error<Float4, kLaw>(in_lanes(d_begin), in_lanes(change), group.block, 0,
                                              multiplier);
      multiplier += Float4::kLanes;
    }
    return sum_of_lanes<double>(sum);
  });
}

}  // namespace pleat
