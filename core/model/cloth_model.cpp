#include "core/model/cloth_model.h"

#include "core/base/check.h"
#include "core/model/elements.h"

namespace pleat {

namespace {

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
  bool is_plain = true;
  for_each_element_kind(*this, [&is_plain](const auto& kind) {
    is_plain = is_plain && (kind.kInPlainLattice || kind.empty());
  });
  return is_plain;
}

void ClothModel::validate() const {
  const int n = n_vertices();
  const auto exists = [n](VertexId v) { return v >= 0 && v < n; };
  PLEAT_CHECK(n >= 1, "a model has at least one vertex");
  PLEAT_CHECK(masses.allFinite() && masses.minCoeff() >= 0, "masses are not negative");
  check_hanging(*this);
  PLEAT_CHECK(gravity.allFinite(), "gravity is finite");
  for_each_element_kind(*this, [&exists](const auto& kind) {
    kind.check();
    kind.for_each_pair([&exists](VertexId a, VertexId b) {
      PLEAT_CHECK(exists(a) && exists(b) && a != b, "an element joins vertices of the model");
    });
  });
  std::vector<bool> pinned(static_cast<std::size_t>(n), false);
  for (const Pin& pin : pins) {
    PLEAT_CHECK(exists(pin.vertex) && !pinned[pin.vertex], "a vertex has at most one pin");
    PLEAT_CHECK(!hangs(pin.vertex), "a pin holds no hanging vertex but its parents");
    pinned[pin.vertex] = true;
  }
  if (strain_limit) {
    strain_limit->options.validate();
    for (const GaugeEdge& edge : strain_limit->edges)
      PLEAT_CHECK(exists(edge.a) && exists(edge.b) && edge.a != edge.b && edge.rest_length > 0,
                  "an edge with limits joins vertices of the model and has a length");
  }
  PLEAT_CHECK(rest_coordinates.cols() == 0 || rest_coordinates.cols() == n,
              "rest coordinates for all or none");
}

}  // namespace pleat
