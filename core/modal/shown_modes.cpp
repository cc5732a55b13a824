#include "core/modal/shown_modes.h"

#include <string>

#include "core/base/check.h"
#include "core/modal/cloth_modes.h"
#include "core/modal/surface_arap.h"

namespace pleat {
namespace {

void check_solved(const SolveReport& report) {
  if (report.ends_run()) throw InputError("", "the modes were not found: " + report.message);
}

void scale_to_one(Eigen::Ref<Eigen::VectorXd> move) {
  const double farthest = move.reshaped(3, move.size() / 3).colwise().norm().maxCoeff();
  if (farthest > 0) move /= farthest;
}

}  // namespace

namespace {

/// map(shape) is a mode as the surface shows it.
template <class Map>
SurfaceModes shown_modes(const Modes& modes, Eigen::Index n_surface, const Map& map) {
  SurfaceModes shown;
  shown.n_rigid = modes.n_rigid;
  Eigen::Index first = modes.n_rigid;
  while (first < modes.size() && is_costless(modes, first)) ++first;
  shown.n_costless = static_cast<int>(first) - modes.n_rigid;
  const Eigen::Index count = modes.size() - first;
  shown.stiffness = modes.stiffness.tail(count);
  shown.residuals = modes.residuals.tail(count);
  shown.moves.resize(3 * n_surface, count);
  for (Eigen::Index m = 0; m < count; ++m) {
    const Eigen::VectorXd shape = modes.shapes.col(first + m);
    shown.moves.col(m) = flat(Positions(map(shape.reshaped(3, shape.size() / 3))));
    scale_to_one(shown.moves.col(m));
  }
  return shown;
}

}  // namespace

SurfaceModes whole_surface_modes(const Modes& modes) {
  return shown_modes(modes, modes.shapes.rows() / 3, [](const Positions& shape) { return shape; });
}

SurfaceModes volume_surface_modes(const Positions& surface, const std::vector<Triangle>& triangles,
                                  const ModalOptions& options) {
  const CarryingVolume carrying = carrying_volume(surface, triangles, options);
  Modes modes;
  check_solved(volume_modes(carrying.volume, options.n_modes, modes));
  SurfaceModes shown = shown_modes(modes, surface.cols(),
                                   [&](const Positions& shape) { return carrying.surface(shape); });
  shown.n_tets = static_cast<int>(carrying.volume.tets.size());
  return shown;
}

SurfaceModes surface_modes(const Positions& surface, const std::vector<Triangle>& triangles,
                           int count) {
  const Eigen::VectorXd areas = surface_areas(surface, triangles);
  for (Eigen::Index v = 0; v < areas.size(); ++v)
    if (!(areas[v] > 0))
      throw InputError("", "expected every vertex in a triangle with an area; vertex " +
                               std::to_string(v) + " is in none");
  const Eigen::MatrixXd rigid = rigid_motions(surface, surface_parts(surface.cols(), triangles));
  const Eigen::Index most = surface.size() - rigid.cols();
  if (count < 1 || count > most)
    throw InputError("", "expected 1 to " + std::to_string(most) + " modes, all that " +
                             std::to_string(surface.cols()) + " vertices have, found " +
                             std::to_string(count));
  Modes modes;
  check_solved(lowest_modes(surface_arap_hessian(surface, triangles, 1),
                            areas.replicate(1, 3).transpose().reshaped(), rigid, count, modes));
  return whole_surface_modes(modes);
}

Eigen::VectorXd volume_motion_shares(const KeyCompletion& completion,
                                     const std::vector<KeyCompletion::Frame>& frames) {
  if (completion.bodies().size() != 1)
    throw InputError(
        "", "expected a surface in one part, found " + std::to_string(completion.bodies().size()));
  const ModalBody& body = completion.bodies().front();
  const TetMesh& rest = body.carrying().volume;
  std::vector<Positions> shapes;
  shapes.reserve(frames.size());
  for (const KeyCompletion::Frame& frame : frames)
    shapes.push_back(body.volume_positions(frame.bodies.front()));
  return motion_shares(body.modes().front(), vertex_volumes(rest), rest.rest_positions, shapes);
}

}  // namespace pleat
