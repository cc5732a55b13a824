#include "native-tests/support/graded_sheets.h"

#include <array>

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
