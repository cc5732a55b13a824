#include "core/model/hanging_vertices.h"

#include "core/base/check.h"

namespace pleat {

void Combination::add(VertexId vertex, double factor) {
  for (std::size_t t = 0; t < n_terms; ++t) {
    if (terms[t].vertex != vertex) continue;
    terms[t].factor += factor;
    return;
  }
  terms[n_terms++] = {vertex, factor};
}

FreeCombinations::FreeCombinations(int n_vertices, std::span<const HangingVertex> hanging) {
  ends_.reserve(static_cast<std::size_t>(n_vertices));
  for (int i = 0; i < n_vertices; ++i) ends_.push_back({VertexId(i), VertexId(i)});
  for (const HangingVertex& h : hanging) ends_[h.vertex] = h.parents;
}

Combination FreeCombinations::operator()(std::span<const VertexId> vertices,
                                         std::span<const double> factors) const {
  PLEAT_CHECK(vertices.size() <= 3 && factors.size() == vertices.size(),
              "an element joins three vertices at most");
  Combination sum;
  for (std::size_t k = 0; k < vertices.size(); ++k)
    for (const VertexId end : ends_[vertices[k]]) sum.add(end, factors[k] / 2);
  return sum;
}

}  // namespace pleat
