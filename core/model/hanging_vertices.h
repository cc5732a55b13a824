#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/mesh/quad_mesh.h"
#include "core/model/state.h"

namespace pleat {

/// x = S y: places or velocities y of the vertices that move freely, and of those that hang the
/// means of their parents'.
template <class Columns>
void place_between_parents(std::span<const HangingVertex> hanging, Columns&& columns) {
  for (const HangingVertex& h : hanging)
    columns.col(h.vertex) = (columns.col(h.parents[0]) + columns.col(h.parents[1])) / 2;
}

inline void place_between_parents(std::span<const HangingVertex> hanging, State& state) {
  place_between_parents(hanging, state.positions);
  place_between_parents(hanging, state.velocities);
}

/// f_y = S^T f_x: gives each parent half of the force, or of whatever else adds up, at a hanging
/// vertex, where nothing stays.
template <class Columns>
void pull_to_parents(std::span<const HangingVertex> hanging, Columns&& columns) {
  for (const HangingVertex& h : hanging) {
    for (const VertexId parent : h.parents) columns.col(parent) += columns.col(h.vertex) / 2;
    columns.col(h.vertex).setZero();
  }
}

/// c_1 x_1 + c_2 x_2 + ..., every vertex at most once.
struct Combination {
  struct Term {
    VertexId vertex;
    double factor = 0;  ///< c
  };
  std::array<Term, 6> terms;  ///< enough for three vertices that hang
  std::size_t n_terms = 0;

  void add(VertexId vertex, double factor);
};

/// Says what a sum of places is in places of vertices that do not hang.
class FreeCombinations {
 public:
  FreeCombinations(int n_vertices, std::span<const HangingVertex> hanging);

  /// Three vertices at most.
  Combination operator()(std::span<const VertexId> vertices, std::span<const double> factors) const;

 private:
  /// The two that each vertex is in the middle of: itself twice when it does not hang.
  std::vector<std::array<VertexId, 2>> ends_;
};

}  // namespace pleat
