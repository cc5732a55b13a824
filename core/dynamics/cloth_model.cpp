#include "core/dynamics/cloth_model.h"

#include "core/base/check.h"

namespace pleat {

void ClothModel::validate() const {
  const int n = n_vertices();
  const auto exists = [n](VertexId v) { return v >= 0 && v < n; };
  PLEAT_CHECK(n >= 1, "a model has at least one vertex");
  PLEAT_CHECK(masses.allFinite() && masses.minCoeff() > 0, "masses are positive");
  PLEAT_CHECK(gravity.allFinite(), "gravity is finite");
  for (const Spring& spring : springs) {
    PLEAT_CHECK(exists(spring.a) && exists(spring.b) && spring.a != spring.b,
                "a spring joins two vertices");
    PLEAT_CHECK(spring.stiffness >= 0 && spring.rest_length >= 0 && spring.damping >= 0,
                "stiffness, rest length and damping are not negative");
  }
  for (const BendElement& bend : bends) {
    PLEAT_CHECK(exists(bend.vertices[0]) && exists(bend.vertices[1]) && exists(bend.vertices[2]),
                "a bending element joins three vertices");
    PLEAT_CHECK(bend.stiffness >= 0, "bending stiffness is not negative");
  }
  std::vector<bool> pinned(static_cast<std::size_t>(n), false);
  for (const Pin& pin : pins) {
    PLEAT_CHECK(exists(pin.vertex) && !pinned[pin.vertex], "a vertex has at most one pin");
    pinned[pin.vertex] = true;
  }
  PLEAT_CHECK(rest_coordinates.cols() == 0 || rest_coordinates.cols() == n,
              "rest coordinates for all or none");
}

}  // namespace pleat
