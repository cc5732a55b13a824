#pragma once

#include <vector>

#include "core/contact/body_surface.h"
#include "core/mesh/quad_mesh.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {

/// Cloth whose faces pass neither through each other nor through bodies, nor come nearer to them
/// than they rest.
struct SelfContact {
  std::vector<Triangle> faces;         ///< active ones
  std::vector<HangingVertex> hanging;  ///< vertices of these faces that hang
  Positions rest_positions;            ///< [m]
  double thickness = 0;  ///< gap that faces rest at [m], positive; less where they were as near
  double friction = 0;   ///< Coulomb coefficient of cloth on cloth, not below 0
  std::vector<BodySurface> bodies{};
  double body_gap = 0;    ///< gap that cloth rests at off a body [m], positive where there is one
  bool is_loose = false;  ///< cloth meets bodies alone, and passes through itself
};

/// Measures of what the guard took from a motion.
struct HeldBack {
  int n_vertices = 0;       ///< whose way was shortened, or that were pushed
  double squared_loss = 0;  ///< sum of squared distances from where they would have been [m^2]
  bool is_blocked = false;  ///< prescribed vertices on both sides left no way, and stayed behind
};

}  // namespace pleat
