#include "core/fabric/spring_lattice.h"

#include <cmath>

#include "core/base/check.h"
#include "core/base/formatted.h"
#include "core/mesh/mesh_lines.h"

namespace pleat {
namespace {

void check_edge_stiffness(double stiffness, double aspect, const FabricConstants& fabric,
                          const char* thread) {
  if (stiffness >= 0) return;
  throw InputError(
      "/fabric",
      formatted("%s: expected cells whose shear stiffness %g N/m the %s edges can carry, got "
                "cells %.3g times as "
                "long along %s as across, which would need springs of negative stiffness",
                fabric.name.c_str(), fabric.shear, thread, aspect, thread));
}

/// kappa = 2/(L1+L2) [(x2 - x1)/L2 - (x1 - x0)/L1], E = 1/2 B w (L1+L2)/2 |kappa|^2.
BendElement quadratic_bend(const LineChord& chord, double rigidity) {
  const double sum = chord.arm_before + chord.arm_after;
  const double w0 = 2 / (sum * chord.arm_before);
  const double w2 = 2 / (sum * chord.arm_after);
  return {{chord.before, chord.middle, chord.after},
          {w0, -(w0 + w2), w2},
          rigidity * chord.width * 0.5 * sum};
}

void append_bends(const QuadMesh& mesh, const ThreadEdges& edges, const FabricConstants& fabric,
                  BendingLaw law, SpringLattice& lattice) {
  const auto rigidity = [&](Thread thread) {
    return thread == Thread::warp ? fabric.bend_warp : fabric.bend_weft;
  };
  for (const LineChord& chord : line_chords(mesh, edges)) {
    // A line that turns from one thread into the other bends like both.
    const double B = (rigidity(chord.thread_before) + rigidity(chord.thread_after)) / 2;
    if (B == 0) continue;
    if (law == BendingLaw::quadratic) {
      lattice.bends.push_back(quadratic_bend(chord, B));
      continue;
    }
    const double arm = 0.5 * (chord.arm_before + chord.arm_after);
    lattice.chord_bends.push_back(chord_bend(chord.before, chord.after, arm, B * chord.width));
  }
}

}  // namespace

SpringLattice spring_lattice(const QuadMesh& mesh, const FabricConstants& fabric, BendingLaw law,
                             double stiffness_exponent) {
  const ThreadEdges edges = thread_edges(mesh);
  const double tau = 2 * fabric.damping_ratio / kReferenceFrequency;  // [s]
  const auto distance = [&](VertexId a, VertexId b) {
    return (mesh.rest_positions().col(a) - mesh.rest_positions().col(b)).norm();
  };
  const auto spring = [&](VertexId a, VertexId b, double k, double length, SpringKind kind) {
    return Spring{a, b, k, length, tau * k, kind};
  };
  std::vector<double> stiffness(edges.edges.size(), 0);
  std::vector<Spring> diagonals;
  auto face_edges = edges.of_faces.begin();
  for (const QuadFace& face : mesh.faces()) {
    if (!face.active()) continue;
    const std::array<int, 4>& e = *face_edges++;
    // A cell that is not a rectangle is taken for the one with its mean edge lengths.
    const double a = 0.5 * (edges.edges[e[0]].length + edges.edges[e[1]].length);
    const double b = 0.5 * (edges.edges[e[2]].length + edges.edges[e[3]].length);
    const double warp_modulus = fabric.stretch_warp - fabric.shear * a * a / (b * b);  // [N/m]
    const double weft_modulus = fabric.stretch_weft - fabric.shear * b * b / (a * a);
    check_edge_stiffness(warp_modulus, a / b, fabric, "warp");
    check_edge_stiffness(weft_modulus, b / a, fabric, "weft");
    const double scale = std::exp2(stiffness_exponent * face.level);
    const double k_warp = scale * warp_modulus * (b / 2) / a;  // this cell's share of an edge [N/m]
    const double k_weft = scale * weft_modulus * (a / 2) / b;
    for (const int k : {0, 1}) stiffness[e[k]] += k_warp;
    for (const int k : {2, 3}) stiffness[e[k]] += k_weft;
    const double k_shear = scale * fabric.shear * (a * a + b * b) / (2 * a * b);
    if (k_shear == 0) continue;
    const auto& c = face.corners;
    diagonals.push_back(spring(c[0], c[2], k_shear, distance(c[0], c[2]), SpringKind::shear));
    diagonals.push_back(spring(c[1], c[3], k_shear, distance(c[1], c[3]), SpringKind::shear));
  }
  SpringLattice lattice;
  for (std::size_t i = 0; i < edges.edges.size(); ++i) {
    const ThreadEdge& edge = edges.edges[i];
    lattice.springs.push_back(
        spring(edge.from, edge.to, stiffness[i], edge.length,
               edge.thread == Thread::warp ? SpringKind::warp : SpringKind::weft));
  }
  lattice.springs.insert(lattice.springs.end(), diagonals.begin(), diagonals.end());
  if (law != BendingLaw::none) append_bends(mesh, edges, fabric, law, lattice);
  lattice.masses = fabric.areal_density * mesh.vertex_areas();
  return lattice;
}

std::vector<BendElement> line_bends(const QuadMesh& mesh, double rigidity) {
  FabricConstants fabric;
  fabric.bend_warp = fabric.bend_weft = rigidity;
  SpringLattice lattice;
  append_bends(mesh, thread_edges(mesh), fabric, BendingLaw::quadratic, lattice);
  return std::move(lattice.bends);
}

}  // namespace pleat
