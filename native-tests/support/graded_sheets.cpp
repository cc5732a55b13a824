#include "native-tests/support/graded_sheets.h"

#include <array>

#include "core/refinement/mesh_match.h"

namespace pleat {

QuadMesh graded_sheet(std::uint64_t seed) {
  Random random(seed);
  QuadMesh mesh = sheet_with_aspect(3, 3, 1.2);
  for (int split = 0; split < 4; ++split) {
    const FaceId face(random.below(static_cast<std::int64_t>(mesh.faces().size())));
    if (mesh.faces()[static_cast<std::size_t>(face)].level < 3) mesh.refine(std::array{face});
  }
  return mesh;
}

RefinementPlan patchy_plan(const QuadMesh& base) {
  RefinementPlan plan;
  plan.examples = {{"walk", BendFeatures::Zero(2, 3)}};
  plan.patterns.assign(static_cast<std::size_t>(base.n_vertices()), 1);
  plan.options.level_cap = 2;
  QuadMesh mesh = base;
  for (int f = 0; f < base.n_base_faces(); f += 3) {
    plan.splits.push_back({FaceId(f), 4});
    mesh.refine(std::array{FaceId(f)});
  }
  plan.n_vertices = mesh.n_vertices();
  plan.base_mesh = base_fingerprint(base);
  plan.curvature_limits = {1, 2, 3};
  return plan;
}

Eigen::MatrixXd prolongation(const ClothModel& model) {
  std::vector<Eigen::Index> column(static_cast<std::size_t>(model.n_vertices()), -1);
  Eigen::Index n_free = 0;
  for (int i = 0; i < model.n_vertices(); ++i)
    if (model.masses[i] > 0) column[static_cast<std::size_t>(i)] = 3 * n_free++;
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(3 * model.n_vertices(), 3 * n_free);
  for (int i = 0; i < model.n_vertices(); ++i)
    if (model.masses[i] > 0)
      S.block<3, 3>(3 * i, column[static_cast<std::size_t>(i)]).setIdentity();
  for (const HangingVertex& h : model.hanging)
    for (const VertexId parent : h.parents)
      S.block<3, 3>(3 * h.vertex, column[static_cast<std::size_t>(parent)]) = Mat3::Identity() / 2;
  return S;
}

}  // namespace pleat
