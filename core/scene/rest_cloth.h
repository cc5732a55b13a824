#pragma once

#include <optional>
#include <vector>

#include "core/model/stretch.h"
#include "core/scene/scene.h"

namespace pleat {

/// The unrefined quads of cloth that is made of them; none of other cloth.
std::optional<QuadMesh> base_quads(const Scene& scene);

/// The cloth of a scene as the scene refines it, by its plan or level.
RestCloth rest_cloth(const Scene& scene);

/// Refined uniformly, to a level that check_level lets pass.
RestCloth rest_cloth(const Scene& scene, int level);

/// Rest area of each vertex [m^2]; particles count by their mass.
Eigen::VectorXd rest_areas(const RestCloth& cloth);

/// The edges by which the cloth's stretch is measured.
std::vector<GaugeEdge> gauge_edges(const RestCloth& cloth);

/// The vertices that a rule pins, ascending unless the scene lists them.
std::vector<VertexId> pinned_vertices(const PinRule& rule, const RestCloth& cloth);

}  // namespace pleat
