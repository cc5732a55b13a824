#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/moving_boxes.h"
#include "core/contact/surface_pair.h"
#include "core/mesh/quad_mesh.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Straight ways of all vertices over some time, each with room to either side on each axis.
struct Corridors {
  Positions begins, ends;  ///< [m]
  Eigen::VectorXd rooms;   ///< one of each vertex, not below 0 [m]
};

/// Finds the pairs of surfaces, a vertex and a face or two edges, that may come near each other.
///
/// Sides of a pair have no vertex in common, and none is parent of a vertex that hangs in the
/// other. An edge that a hanging vertex halves counts only by its halves.
class NearPairs {
 public:
  /// faces    of which a vertex may be in any number, or in none: then it is in no pair
  /// hanging  of these faces
  ///
  /// Throws ContractError where a face names a vertex twice or one that is not there.
  NearPairs(std::vector<Triangle> faces, std::span<const HangingVertex> hanging, int n_vertices);
  /// Pairs are only of vertices whose groups may overlap.
  ///
  /// groups  one for each vertex; those of a face are of one group
  NearPairs(std::vector<Triangle> faces, std::span<const HangingVertex> hanging,
            std::vector<BoxGroup> groups);

  /// Finds anew. A pair is left out only if on some axis each vertex a of one side lies above each
  /// b of the other by their rooms and the margin, both when the time begins and when it ends:
  ///
  ///     x_a - x_b >= room_a + room_b + margin.
  ///
  /// The sides then stay apart by the margin all along, while every vertex keeps within its room of
  /// its way on each axis. Other pairs are listed, and some more for rounding: 1e-6 of the distance
  /// from the first vertex. Left out are also all pairs with a vertex that is lost: a place or a
  /// room that is not finite, or beyond 1e30 m.
  ///
  /// corridors  of all vertices
  /// margin     [m], finite, not below 0
  ///
  /// Source: docs/methods/contact.md.
  ///
  /// False, and no pair, where corridors overlap so much that a list would be no use: each face's
  /// box a hundred others, as of cloth that explodes.
  bool detect(const Corridors& corridors, double margin);

  /// Ascending, each once; the same for the same corridors, whatever was found before. Valid until
  /// the next `detect`, empty before the first.
  std::span<const SurfacePair> pairs() const { return pairs_; }

  /// Edges of the faces, ascending, without those that hanging vertices halve.
  std::span<const std::array<VertexId, 2>> edges() const { return edges_; }

  /// Times that the tree was made.
  int n_builds() const { return n_builds_; }

  /// Memory that it holds [bytes].
  std::size_t bytes() const;

 private:
  /// A face or an edge in the order of the tree, with its number in the ascending order.
  struct OrderedFace {
    Triangle corners;
    int number;
  };
  struct OrderedEdge {
    std::array<VertexId, 2> ends;
    int number;
  };
  /// First face of a leaf, and first of the vertices and edges that it owns.
  struct Leaf {
    int face, vertex, edge;
  };

  void fit(const Corridors& corridors, double margin);
  double fit_faces();
  MovingBox face_box(const Triangle& face) const;
  void build();
  void add_faces(int leaf_of_vertices, int leaf_of_faces);
  void add_edges(int leaf_a, int leaf_b);
  template <class Rule>
  void leave_out(const Rule& rule);
  void list_pairs();

  int n_vertices_;
  std::vector<BoxGroup> groups_;  // empty where all is cloth
  std::vector<Triangle> faces_;   // ascending, corners too
  std::vector<std::array<VertexId, 2>> edges_;
  std::vector<std::array<int, 3>> face_edges_;    // numbers of each face's edges; -1 where halved
  std::vector<std::array<VertexId, 2>> parents_;  // parents of each vertex, if any hangs

  MovingBoxes tree_;
  double surface_at_build_ = 0;  // [m^2]
  int n_builds_ = 0;
  std::vector<OrderedFace> ordered_faces_;
  std::vector<OrderedEdge> ordered_edges_;
  std::vector<VertexId> ordered_vertices_;
  std::vector<Leaf> leaves_;                          // and the end
  std::vector<int> vertex_owned_at_, edge_owned_at_;  // builds in which they last got an owner
  std::vector<MovingBox> vertex_boxes_;
  std::vector<MovingBox> face_boxes_, edge_boxes_;  // ordered as the tree has them

  std::vector<std::uint64_t> vertex_face_, edge_edge_;  // numbers of both sides
  std::vector<std::uint64_t> sorted_;
  std::vector<int> starts_;
  std::vector<SurfacePair> pairs_;
};

}  // namespace pleat
