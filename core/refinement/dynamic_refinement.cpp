#include "core/refinement/dynamic_refinement.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/check.h"
#include "core/refinement/mesh_match.h"
#include "core/refinement/vertex_curvature.h"

namespace pleat {
namespace {

double largest_at_corners(const QuadFace& face, const Eigen::VectorXd& curvature) {
  double largest = 0;
  for (const VertexId v : face.corners) largest = std::max(largest, curvature[v]);
  return largest;
}

/// True when four active siblings can be merged: no face beside them is split once more than they
/// are, which would halve an edge of theirs.
bool can_merge(const QuadMesh& mesh, const QuadFace& parent) {
  for (const FaceId child : parent.children) {
    if (!child.valid() || !mesh.faces()[child].active()) return false;
    const auto& c = mesh.faces()[child].corners;
    for (int k = 0; k < 4; ++k)
      if (mesh.middle(c[k], c[(k + 1) % 4]).valid()) return false;
  }
  return true;
}

/// Groups to merge, by their parent. Curvature is of the vertices that were there before the mesh
/// was split for this frame; groups with a later one stay.
std::vector<bool> merged_groups(const QuadMesh& mesh, const Eigen::VectorXd& curvature,
                                double limit) {
  std::vector<bool> is_merged(mesh.faces().size(), false);
  for (std::size_t f = 0; f < is_merged.size(); ++f) {
    const QuadFace& parent = mesh.faces()[f];
    if (!can_merge(mesh, parent)) continue;
    const auto is_calm = [&](FaceId child) {
      const QuadFace& face = mesh.faces()[child];
      for (const VertexId v : face.corners)
        if (v >= curvature.size()) return false;
      return largest_at_corners(face, curvature) < limit;
    };
    is_merged[f] = std::all_of(parent.children.begin(), parent.children.end(), is_calm);
  }
  return is_merged;
}

/// The base mesh with all splits of another refinement but those of the merged groups.
QuadMesh rebuilt(const QuadMesh& base, const QuadMesh& from, const std::vector<bool>& is_merged) {
  QuadMesh mesh = base;
  std::vector<FaceId> matching(mesh.faces().size());  // the face of `from` with the same cloth
  for (std::size_t f = 0; f < matching.size(); ++f)
    matching[f] = FaceId(static_cast<std::int64_t>(f));
  for (std::size_t begin = 0; begin < mesh.faces().size();) {  // level by level
    const std::size_t end = mesh.faces().size();
    std::vector<FaceId> splits;
    for (std::size_t f = begin; f < end; ++f)
      if (!from.faces()[matching[f]].active() && !is_merged[matching[f]])
        splits.emplace_back(static_cast<std::int64_t>(f));
    mesh.refine(splits);
    matching.resize(mesh.faces().size());
    for (const FaceId split : splits)
      for (int k = 0; k < 4; ++k)
        matching[mesh.faces()[split].children[k]] = from.faces()[matching[split]].children[k];
    begin = end;
  }
  return mesh;
}

/// Velocities on a coarser mesh: what a vertex that goes or begins to hang carries is its parents'.
Positions gathered_velocities(const GradedState& old, const QuadMesh& coarser) {
  const std::vector<VertexId> matching = matching_vertices(coarser, old.mesh);
  std::vector<bool> stays(static_cast<std::size_t>(old.mesh.n_vertices()), false);
  for (const VertexId v : matching) stays[v] = true;
  for (const HangingVertex& h : coarser.hanging_vertices()) stays[matching[h.vertex]] = false;
  // Both are per areal density: masses are areas [m^2], momenta [m^3/s].
  Eigen::VectorXd masses = old.mesh.vertex_areas();
  Positions momenta = old.velocities * masses.asDiagonal();
  for (Eigen::Index v = masses.size(); v-- > 0;) {  // parents come before
    if (stays[v]) continue;
    const VertexParents& parents = old.mesh.parents()[v];
    for (int k = 0; k < parents.count; ++k) {
      masses[parents.vertices[k]] += masses[v] / parents.count;
      momenta.col(parents.vertices[k]) += momenta.col(v) / parents.count;
    }
  }
  Positions velocities(3, coarser.n_vertices());
  for (std::size_t v = 0; v < matching.size(); ++v)
    velocities.col(static_cast<Eigen::Index>(v)) = momenta.col(matching[v]) / masses[matching[v]];
  straighten(coarser.hanging_vertices(), velocities);
  return velocities;
}

}  // namespace

void DynamicOptions::validate() const {
  if (!(split_curvature > 0))
    throw InputError("split curvature",
                     "expected a number > 0, got " + std::to_string(split_curvature));
  if (max_level < 0 || max_level > kMaxLevel)
    throw InputError("finest level", "expected a whole number from 0 to " +
                                         std::to_string(kMaxLevel) + ", got " +
                                         std::to_string(max_level));
}

DynamicRefinement::DynamicRefinement(QuadMesh base, const DynamicOptions& options)
    : base_(std::move(base)), options_(options) {
  options_.validate();
  PLEAT_CHECK(static_cast<int>(base_.faces().size()) == base_.n_base_faces(),
              "the base mesh is not refined");
}

DynamicRefinement::Result DynamicRefinement::adapted(GradedState state) const {
  QuadMesh& mesh = state.mesh;
  const Eigen::VectorXd curvature = VertexCurvature(mesh).of(state.positions);
  const std::size_t n_before = mesh.faces().size();
  std::vector<FaceId> wanted;
  for (std::size_t f = 0; f < n_before; ++f) {
    const QuadFace& face = mesh.faces()[f];
    if (face.active() && face.level < options_.max_level &&
        largest_at_corners(face, curvature) > options_.split_curvature)
      wanted.emplace_back(static_cast<std::int64_t>(f));
  }
  if (!wanted.empty()) {
    mesh.refine(wanted);
    state.positions = continued(state.positions, mesh);
    state.velocities = continued(state.velocities, mesh);
  }
  const int n_split = static_cast<int>(mesh.faces().size() - n_before) / 4;
  const std::vector<bool> is_merged = merged_groups(mesh, curvature, options_.split_curvature / 2);
  const auto n_merged = static_cast<int>(std::count(is_merged.begin(), is_merged.end(), true));
  if (n_merged == 0) return {std::move(state), n_split, 0};
  QuadMesh coarser = rebuilt(base_, mesh, is_merged);
  Positions positions = MeshSample(coarser, mesh).of(state.positions);
  Positions velocities = gathered_velocities(state, coarser);
  return {{std::move(coarser), std::move(positions), std::move(velocities)}, n_split, n_merged};
}

}  // namespace pleat
