#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/hierarchy/collapse_guards.h"
#include "core/hierarchy/transfer.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Choice of the vertices that a coarser level keeps.
enum class LevelSelection {
  quadrics,  ///< half-edge collapses, the cheapest first (EdgeCollapse); levels have triangles
  thinned,   ///< every vertex that is out has two neighbours that stay (thinned_graph.h)
};
/// Their names in files and on the command line, in the order of the enumeration.
constexpr std::array<std::string_view, 2> kLevelSelectionNames{"quadrics", "thinned"};

struct HierarchyOptions {
  int n_coarser = 3;  ///< levels beside the finest, 1 or more
  LevelSelection selection = LevelSelection::quadrics;
  /// Share of a level's vertices that the next coarser one keeps, in (0.1, 0.9); for quadrics
  /// alone.
  double ratio = 0.5;
  TransferWeights weights = TransferWeights::inverse_distance;
  CollapseGuards guards{};  ///< rules for quadrics alone

  /// Throws InputError at the option's name.
  void validate() const;
};

struct LevelEdge {
  VertexId a, b;    ///< numbers in the level
  double geodesic;  ///< length of a shortest path on the unstrained surface [m]
  double chord;     ///< distance in the rest shape [m]
};

/// A level of a hierarchy. Its vertices are numbered anew, in the order of the finest mesh.
struct MeshLevel {
  std::vector<VertexId> vertices;   ///< numbers in the finest mesh, ascending
  std::vector<Triangle> triangles;  ///< none on thinned levels
  std::vector<LevelEdge> edges;
  Transfer from_coarser;  ///< empty on the coarsest

  int n_vertices() const { return static_cast<int>(vertices.size()); }
};

/// Ever coarser meshes of vertices of a mesh.
struct MeshHierarchy {
  std::vector<MeshLevel> levels;  ///< the finest first
  /// Why there are fewer levels than asked for; empty when there are all.
  std::string shortage;
};

/// mesh      sound (mesh_fault); throws ContractError otherwise
/// is_fixed  of each vertex that every level has to keep, such as pinned ones; empty: none
///
/// Ends at the last level that keeps its share of vertices, and says so.
/// Source: Mueller, Hierarchical position based dynamics, VRIPHYS 2008 (levels of a subset and
/// their parents); selection by quadrics (EdgeCollapse).
MeshHierarchy mesh_hierarchy(const TriangleMesh& mesh, const std::vector<bool>& is_fixed,
                             const HierarchyOptions& options);

/// The vertices of a level where they are in a state of the finest mesh [m].
Positions positions_on(const MeshLevel& level, const Positions& finest);

}  // namespace pleat
