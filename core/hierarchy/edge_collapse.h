#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <vector>

#include "core/hierarchy/collapse_guards.h"
#include "core/hierarchy/quadric.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Makes a triangle mesh coarser, one half-edge collapse after the other, the cheapest first. A
/// collapse moves a vertex into a neighbour, so what stays of the mesh are its own vertices.
///
/// The cost is the quadric of both vertices where they meet: planes of the triangles (by area) and
/// of the border (upright on it, by squared length), and a thousandth of a plane for each vertex
/// that was merged there. Equal costs go by the edge's length, then by numbers.
///
/// Never collapsed are vertices that are fixed, corners of the border (which turns there by more
/// than 45 degrees) and vertices where more than one fan of triangles meets. No collapse turns a
/// triangle over or leaves it without area, joins what was apart (link condition), takes the last
/// triangle of a vertex or pulls a border inwards. Guards can be left out (CollapseGuards); levels
/// may then be no sound meshes.
///
/// Source: Garland & Heckbert, Surface simplification using quadric error metrics, SIGGRAPH 1997;
/// Dey, Edelsbrunner, Guha & Nekhayev, Topology preserving edge contraction, Publications de
/// l'Institut Mathematique 1999 (link condition).
class EdgeCollapse {
 public:
  /// mesh      sound (mesh_fault); throws ContractError otherwise. Positions decide, not the
  /// pattern. is_fixed  of each vertex; empty: none
  EdgeCollapse(const TriangleMesh& mesh, const std::vector<bool>& is_fixed,
               CollapseGuards guards = {});

  /// Collapses until so many vertices are left. False when no more may be collapsed before.
  bool reach(int n_vertices);

  int n_vertices() const { return n_vertices_; }
  /// Vertices left, by their numbers in the mesh, ascending.
  std::vector<VertexId> vertices() const;
  /// Triangles left, in the mesh's order, between vertices of the mesh.
  std::vector<Triangle> triangles() const;

 private:
  struct Candidate {
    double cost, length;
    VertexId from, to;
    std::int32_t from_version, to_version;

    bool operator>(const Candidate& other) const;
  };
  using Numbers = std::vector<std::int32_t>;

  void add_planes(const TriangleMesh& mesh);
  void keep_corners(const TriangleMesh& mesh);
  void offer(VertexId from, VertexId to);
  void offer_around(VertexId vertex);
  std::vector<VertexId> neighbours(VertexId vertex) const;
  std::size_t n_shared_triangles(VertexId from, VertexId to) const;
  bool keeps_triangles(VertexId from, VertexId to) const;
  bool keeps_border(VertexId from, VertexId to) const {
    return !is_border_[from] || is_border_[to];
  }
  bool keeps_links(VertexId from, VertexId to);
  bool keeps_shapes(VertexId from, VertexId to) const;
  bool is_allowed(VertexId from, VertexId to);
  void collapse(VertexId from, VertexId to);

  CollapseGuards guards_;
  Positions positions_;   ///< positions relative to their mean [m]
  double mean_area_ = 0;  ///< mean area of a vertex [m^2]
  std::vector<Triangle> triangles_;
  std::vector<bool> is_gone_;  ///< true for triangles taken out
  std::vector<Numbers> triangles_of_;
  std::vector<Quadric> quadrics_;
  std::vector<bool> is_kept_, is_border_;
  Numbers versions_;  ///< version of a vertex's candidates, -1 once collapsed
  std::vector<std::vector<VertexId>> refused_;  ///< ends for a vertex that guards refused
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates_;
  Numbers mark_;
  std::int32_t mark_now_ = 0;
  int n_vertices_ = 0;
};

}  // namespace pleat
