#include "core/dynamics/position_based/lanes/bend_chains.h"

#include <algorithm>
#include <map>
#include <utility>

namespace pleat {
namespace {

/// An element, and whether it is gone through from its third vertex to its first.
struct DirectedBend {
  int element;
  bool is_reversed;
};

/// Elements by the two vertices with which they begin.
class BendStarts {
 public:
  BendStarts(const ClothModel& model, const std::vector<BendConstraint>& bends)
      : bends_(bends), is_free_(bends.size(), false) {
    for (std::size_t e = 0; e < bends.size(); ++e) {
      if (any_hangs(model, bends[e].vertices)) continue;
      is_free_[e] = true;
      const auto element = static_cast<int>(e);
      for (const bool is_reversed : {false, true}) {
        const DirectedBend bend{element, is_reversed};
        by_start_[{vertex(bend, 0), vertex(bend, 1)}].push_back(bend);
      }
    }
  }

  int vertex(const DirectedBend& bend, std::size_t which) const {
    const auto& vertices = bends_[static_cast<std::size_t>(bend.element)].vertices;
    return vertices[bend.is_reversed ? 2 - which : which].value;
  }

  bool is_free(int element) const { return is_free_[static_cast<std::size_t>(element)]; }
  void take(int element) { is_free_[static_cast<std::size_t>(element)] = false; }

  /// The first one not taken that begins with these two and ends at none of `others`.
  const DirectedBend* next(int first, int second, const std::vector<VertexId>& others) const {
    const auto found = by_start_.find({first, second});
    if (found == by_start_.end()) return nullptr;
    for (const DirectedBend& bend : found->second)
      if (is_free(bend.element) &&
          std::find(others.begin(), others.end(), VertexId(vertex(bend, 2))) == others.end())
        return &bend;
    return nullptr;
  }

 private:
  const std::vector<BendConstraint>& bends_;
  std::vector<bool> is_free_;
  std::map<std::pair<int, int>, std::vector<DirectedBend>> by_start_;
};

BendChain::Bend numbers_of(const BendConstraint& bend, const DirectedBend& directed) {
  const auto first = static_cast<float>(bend.weights[0]);
  const auto last = static_cast<float>(bend.weights[2]);
  return directed.is_reversed ? BendChain::Bend{last, first, bend.compliance, directed.element}
                              : BendChain::Bend{first, last, bend.compliance, directed.element};
}

void turn_round(BendChain& chain) {
  std::reverse(chain.vertices.begin(), chain.vertices.end());
  std::reverse(chain.bends.begin(), chain.bends.end());
  for (BendChain::Bend& bend : chain.bends) std::swap(bend.before, bend.after);
}

}  // namespace

std::vector<BendChain> bend_chains(const ClothModel& model,
                                   const std::vector<BendConstraint>& bends) {
  BendStarts starts(model, bends);
  std::vector<BendChain> chains;
  const auto extend = [&](BendChain& chain) {
    while (true) {
      const std::size_t n = chain.vertices.size();
      const DirectedBend* const bend =
          starts.next(chain.vertices[n - 2].value, chain.vertices[n - 1].value, chain.vertices);
      if (bend == nullptr) return;
      starts.take(bend->element);
      chain.vertices.emplace_back(starts.vertex(*bend, 2));
      chain.bends.push_back(numbers_of(bends[static_cast<std::size_t>(bend->element)], *bend));
    }
  };
  for (std::size_t e = 0; e < bends.size(); ++e) {
    if (!starts.is_free(static_cast<int>(e))) continue;
    const DirectedBend first{static_cast<int>(e), false};
    starts.take(first.element);
    BendChain chain;
    chain.vertices.assign(bends[e].vertices.begin(), bends[e].vertices.end());
    chain.bends.push_back(numbers_of(bends[e], first));
    extend(chain);
    turn_round(chain);
    extend(chain);
    turn_round(chain);
    chains.push_back(std::move(chain));
  }
  return chains;
}

// Row i of J has before_i, -(before_i + after_i) and after_i at the vertices i, i + 1 and i + 2.
BendChainFactor bend_chain_factor(const BendChain& chain,
                                  const std::vector<double>& inverse_masses) {
  const auto weight = [&](std::size_t bend, std::size_t vertex) -> double {
    const BendChain::Bend& b = chain.bends[bend];
    if (vertex == bend) return b.before;
    return vertex == bend + 1 ? -(static_cast<double>(b.before) + b.after) : b.after;
  };
  const auto shared = [&](std::size_t earlier, std::size_t later) {
    double sum = 0;
    for (std::size_t v = later; v <= earlier + 2; ++v)
      sum += weight(earlier, v) * inverse_masses[v] * weight(later, v);
    return sum;
  };
  BendChainFactor factor;
  factor.rows.resize(chain.bends.size());
  std::vector<double> pivots(chain.bends.size());
  for (std::size_t i = 0; i < factor.rows.size(); ++i) {
    BendChainFactor::Row& row = factor.rows[i];
    double pivot = shared(i, i) + chain.bends[i].compliance + kRigidCompliance;
    double beside = i > 0 ? shared(i - 1, i) : 0;
    if (i > 1) {
      const double far = shared(i - 2, i);
      row.next_but_one = far / pivots[i - 2];
      beside -= far * factor.rows[i - 1].next;
      pivot -= far * row.next_but_one;
    }
    if (i > 0) {
      row.next = beside / pivots[i - 1];
      pivot -= beside * row.next;
    }
    pivots[i] = pivot;
    row.inverse_pivot = 1 / pivot;
  }
  return factor;
}

}  // namespace pleat
