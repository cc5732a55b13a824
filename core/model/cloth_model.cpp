#include "core/model/cloth_model.h"

#include <algorithm>

#include "core/base/check.h"

namespace pleat {

namespace {

void check_springs(const std::vector<Spring>& springs, int n_vertices) {
  for (const Spring& spring : springs) {
    PLEAT_CHECK(spring.a >= 0 && spring.a < n_vertices && spring.b >= 0 && spring.b < n_vertices &&
                    spring.a != spring.b,
                "a spring joins two vertices");
    PLEAT_CHECK(spring.stiffness >= 0 && spring.rest_length >= 0 && spring.damping >= 0,
                "stiffness, rest length and damping are not negative");
  }
}

/// Zero mass tells whether a vertex hangs.
void check_hanging(const ClothModel& model) {
  const auto is_free = [&model](VertexId v) {
    return v >= 0 && v < model.n_vertices() && !model.hangs(v);
  };
  std::vector<bool> hangs(static_cast<std::size_t>(model.n_vertices()), false);
  for (const HangingVertex& h : model.hanging) {
    PLEAT_CHECK(h.vertex >= 0 && h.vertex < model.n_vertices() && !hangs[h.vertex],
                "a vertex hangs once");
    PLEAT_CHECK(model.hangs(h.vertex), "a hanging vertex has no mass of its own");
    PLEAT_CHECK(h.parents[0] != h.parents[1] && is_free(h.parents[0]) && is_free(h.parents[1]),
                "a vertex hangs between two that do not");
    hangs[h.vertex] = true;
  }
  const auto n_massless = (model.masses.array() == 0).count();
  PLEAT_CHECK(n_massless == static_cast<Eigen::Index>(model.hanging.size()),
              "masses are positive where nothing hangs");
}

}  // namespace

bool ClothModel::is_plain_spring_lattice() const {
  return taut_springs.empty() && chord_bends.empty() && membrane.elements.empty() &&
         !has_fitted_bending() && hinges.empty();
}

void ClothModel::validate() const {
  const int n = n_vertices();
  const auto exists = [n](VertexId v) { return v >= 0 && v < n; };
  const auto all_exist = [&](const auto& vertices) {
    return std::all_of(vertices.begin(), vertices.end(), exists);
  };
  PLEAT_CHECK(n >= 1, "a model has at least one vertex");
  PLEAT_CHECK(masses.allFinite() && masses.minCoeff() >= 0, "masses are not negative");
  check_hanging(*this);
  PLEAT_CHECK(gravity.allFinite(), "gravity is finite");
  check_springs(springs, n);
  check_springs(taut_springs, n);
  for (const BendElement& bend : bends) {
    PLEAT_CHECK(all_exist(bend.vertices), "a bending element joins three vertices");
    PLEAT_CHECK(bend.stiffness >= 0, "bending stiffness is not negative");
  }
  for (const ChordBend& bend : chord_bends)
    PLEAT_CHECK(exists(bend.a) && exists(bend.b), "a bending element joins two vertices");
  for (const MembraneElement& element : membrane.elements)
    PLEAT_CHECK(all_exist(element.vertices), "a membrane element has three vertices");
  PLEAT_CHECK(membrane_relaxation >= 0, "a relaxation time is not negative");
  PLEAT_CHECK(!has_fitted_bending() || fitted_bending.rows() == n, "bending for every vertex");
  for (const Hinge& hinge : hinges)
    PLEAT_CHECK(all_exist(hinge.vertices), "a hinge has four vertices");
  std::vector<bool> pinned(static_cast<std::size_t>(n), false);
  for (const Pin& pin : pins) {
    PLEAT_CHECK(exists(pin.vertex) && !pinned[pin.vertex], "a vertex has at most one pin");
    PLEAT_CHECK(!hangs(pin.vertex), "a pin holds no hanging vertex but its parents");
    pinned[pin.vertex] = true;
  }
  PLEAT_CHECK(rest_coordinates.cols() == 0 || rest_coordinates.cols() == n,
              "rest coordinates for all or none");
}

}  // namespace pleat
