#pragma once

#include <span>
#include <vector>

#include "core/fabric/spring_lattice.h"
#include "core/mesh/quad_mesh.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Two vertices whose distance tells how far cloth is stretched, whatever its elastic model.
struct GaugeEdge {
  VertexId a, b;
  double rest_length = 0;  ///< [m], positive
};

/// A sheet's mesh edges: along warp, then along weft.
std::vector<GaugeEdge> gauge_edges(const QuadMesh& mesh);

/// All edges of a triangle mesh that have a length.
std::vector<GaugeEdge> gauge_edges(const TriangleMesh& mesh);

/// Structural springs that have a length.
std::vector<GaugeEdge> gauge_edges(std::span<const Spring> springs);

/// l/L - 1.
double strain(const GaugeEdge& edge, const PositionsView& positions);

/// |l/L - 1| over the edges of a gauge; 0 without any.
struct Stretch {
  double rms = 0;
  double largest = 0;
};

Stretch stretch(std::span<const GaugeEdge> gauge, const PositionsView& positions);

/// The signed mean l/L - 1 of a gauge's edges at each vertex, for colouring.
class StrainMap {
 public:
  StrainMap(std::span<const GaugeEdge> gauge, int n_vertices);

  /// positions  [m]
  /// Returns one number per vertex, 0 where no edge ends; valid until the next call. Never
  /// allocates.
  const std::vector<float>& update(const PositionsView& positions);

 private:
  std::vector<GaugeEdge> gauge_;
  std::vector<float> inverse_counts_;  // edges per vertex
  std::vector<float> strains_;
};

}  // namespace pleat
