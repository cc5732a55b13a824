#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/files/json_reader.h"
#include "core/model/cloth_model.h"
#include "core/model/stretch.h"
#include "core/scene/cloth_source.h"

namespace pleat {

struct Scene;

/// Cloth that was torn at one time.
struct TornCloth {
  RestCloth cloth;
  /// Vertex that each appended one was split from, which comes before it.
  std::vector<VertexId> origins;
};

/// How a cloth tears: an edge that is stretched beyond its breaking elongation parts the faces at
/// one of its ends, those around that end which lie beyond it from those on the edge's own side.
/// Source: docs/methods/tearing.md.
struct Tearing {
  double breaking_elongation = 0;  ///< (l - L)/L, positive

  /// The cloth once it gave way where it is overloaded; nothing where it holds. Where faces with
  /// overloaded edges hang together it gives way at one place, the worst that can: that unloads the
  /// others. An edge takes the end whose cloth beyond is stretched more, and the other one where
  /// that cannot split.
  ///
  /// gauge      the cloth's edges
  /// positions  of its vertices [m]
  /// pins       at vertices that never split
  std::optional<TornCloth> torn(const RestCloth& cloth, std::span<const GaugeEdge> gauge,
                                const Positions& positions, std::span<const Pin> pins) const;

  /// Columns with those of the vertices that a tear appended: as the ones that they come from.
  Positions split(const Positions& columns, std::span<const VertexId> origins) const;
  /// Forces on the vertices before the tear [N], one column each, shared among what they split into
  /// as their masses [kg] are.
  Positions shared(const Positions& forces, const Eigen::VectorXd& masses_before,
                   const Eigen::VectorXd& masses, std::span<const VertexId> origins) const;
};

/// The section "tearing" of a scene's model.
std::shared_ptr<const Tearing> read_tearing(const JsonReader& reader);
Json json_tearing(const Tearing& tearing);

/// Refuses a scene, all read, whose cloth cannot tear. The reader is at the section "tearing".
void check_tearing(const JsonReader& reader, const Scene& scene);

/// Throws InputError when the scene's cloth tears, for a program whose runs have to keep their
/// vertices.
void expect_whole(const Scene& scene);

}  // namespace pleat
