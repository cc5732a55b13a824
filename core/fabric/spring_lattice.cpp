#include "core/fabric/spring_lattice.h"

#include <cmath>
#include <cstdio>
#include <unordered_map>

#include "core/base/check.h"

namespace pleat {
namespace {

/// An edge of the mesh along one thread direction, gathered from the one or two faces beside it.
struct ThreadEdge {
  VertexId from, to;     // in the direction of growing u or v
  double length = 0;     // at rest [m]
  double width = 0;      // half of the adjacent cells' widths summed [m]
  double stiffness = 0;  // [N/m]
};

/// All edges along one thread direction, and the mesh lines that they form.
class ThreadEdges {
 public:
  explicit ThreadEdges(int n_vertices) : edge_after_(static_cast<std::size_t>(n_vertices), kNone) {}

  void add(VertexId from, VertexId to, double length, double half_width, double stiffness) {
    int& index = edge_after_[from];
    if (index == kNone) {
      index = static_cast<int>(edges_.size());
      edges_.push_back({from, to, length, 0, 0});
    }
    PLEAT_CHECK(edges_[index].to == to,
                "one mesh line runs through a vertex in each thread direction");
    edges_[index].width += half_width;
    edges_[index].stiffness += stiffness;
  }

  const std::vector<ThreadEdge>& edges() const { return edges_; }

  /// The edge that continues a line, or null at its end.
  const ThreadEdge* next(const ThreadEdge& edge) const {
    const int index = edge_after_[edge.to];
    return index == kNone ? nullptr : &edges_[index];
  }

 private:
  static constexpr int kNone = -1;
  std::vector<ThreadEdge> edges_;
  std::vector<int> edge_after_;  // by vertex: the edge that begins there
};

void check_edge_stiffness(double stiffness, double aspect, const FabricConstants& fabric,
                          const char* thread) {
  if (stiffness >= 0) return;
  char sentence[240];
  std::snprintf(sentence, sizeof sentence,
                "%s: expected cells whose shear stiffness %g N/m the %s edges can carry, got "
                "cells %.3g times as "
                "long along %s as across, which would need springs of negative stiffness",
                fabric.name.c_str(), fabric.shear, thread, aspect, thread);
  throw InputError("/fabric", sentence);
}

void append_springs(const ThreadEdges& lines, SpringKind kind, double tau,
                    std::vector<Spring>& springs) {
  for (const ThreadEdge& edge : lines.edges())
    springs.push_back(
        {edge.from, edge.to, edge.stiffness, edge.length, tau * edge.stiffness, kind});
}

/// kappa = 2/(L1+L2) [(x2 - x1)/L2 - (x1 - x0)/L1], E = 1/2 B w (L1+L2)/2 |kappa|^2 with w the mean
/// width of both arms.
BendElement quadratic_bend(const ThreadEdge& before, const ThreadEdge& after, double rigidity) {
  const double sum = before.length + after.length;
  const double w0 = 2 / (sum * before.length);
  const double w2 = 2 / (sum * after.length);
  const double width = 0.5 * (before.width + after.width);
  return {{before.from, before.to, after.to}, {w0, -(w0 + w2), w2}, rigidity * width * 0.5 * sum};
}

void append_bends(const ThreadEdges& lines, double rigidity, BendingLaw law,
                  SpringLattice& lattice) {
  if (rigidity == 0 || law == BendingLaw::none) return;
  for (const ThreadEdge& before : lines.edges()) {
    const ThreadEdge* after = lines.next(before);
    if (after == nullptr) continue;
    if (law == BendingLaw::quadratic) {
      lattice.bends.push_back(quadratic_bend(before, *after, rigidity));
      continue;
    }
    const double arm = 0.5 * (before.length + after->length);
    const double width = 0.5 * (before.width + after->width);
    lattice.chord_bends.push_back(
        chord_bend(before.from, after->to, arm, rigidity * width,
                   law == BendingLaw::arc ? ChordLaw::arc : ChordLaw::linear));
  }
}

}  // namespace

SpringLattice spring_lattice(const QuadMesh& mesh, const FabricConstants& fabric, BendingLaw law) {
  const Positions& x = mesh.rest_positions();
  const auto distance = [&](VertexId a, VertexId b) { return (x.col(a) - x.col(b)).norm(); };
  const double tau = 2 * fabric.damping_ratio / kReferenceFrequency;  // [s]

  SpringLattice lattice;
  ThreadEdges warp(mesh.n_vertices());
  ThreadEdges weft(mesh.n_vertices());
  std::vector<Spring> diagonals;
  for (const QuadFace& face : mesh.faces()) {
    if (!face.active()) continue;
    const auto& c = face.corners;
    // A cell that is not a rectangle is taken for the one with its mean edge lengths.
    const double a = 0.5 * (distance(c[0], c[1]) + distance(c[3], c[2]));
    const double b = 0.5 * (distance(c[0], c[3]) + distance(c[1], c[2]));
    const double warp_modulus = fabric.stretch_warp - fabric.shear * a * a / (b * b);  // [N/m]
    const double weft_modulus = fabric.stretch_weft - fabric.shear * b * b / (a * a);
    check_edge_stiffness(warp_modulus, a / b, fabric, "warp");
    check_edge_stiffness(weft_modulus, b / a, fabric, "weft");
    const double k_warp = warp_modulus * (b / 2) / a;  // this cell's share of one edge [N/m]
    const double k_weft = weft_modulus * (a / 2) / b;
    warp.add(c[0], c[1], distance(c[0], c[1]), b / 2, k_warp);
    warp.add(c[3], c[2], distance(c[3], c[2]), b / 2, k_warp);
    weft.add(c[0], c[3], distance(c[0], c[3]), a / 2, k_weft);
    weft.add(c[1], c[2], distance(c[1], c[2]), a / 2, k_weft);
    const double k_shear = fabric.shear * (a * a + b * b) / (2 * a * b);
    if (k_shear > 0) {
      for (const auto& [p, q] : {std::pair(c[0], c[2]), std::pair(c[1], c[3])})
        diagonals.push_back({p, q, k_shear, distance(p, q), tau * k_shear, SpringKind::shear});
    }
  }
  append_springs(warp, SpringKind::warp, tau, lattice.springs);
  append_springs(weft, SpringKind::weft, tau, lattice.springs);
  lattice.springs.insert(lattice.springs.end(), diagonals.begin(), diagonals.end());
  append_bends(warp, fabric.bend_warp, law, lattice);
  append_bends(weft, fabric.bend_weft, law, lattice);
  lattice.masses = fabric.areal_density * mesh.vertex_areas();
  return lattice;
}

}  // namespace pleat
