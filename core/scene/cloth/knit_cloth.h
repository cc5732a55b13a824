#pragma once

#include <cmath>

#include "core/scene/cloth_source.h"
#include "core/scene/sheet_section.h"

namespace pleat {

/// A kind of spring of a knitted cloth, with the damper beside each.
struct KnitSpring {
  double stiffness = 0;  ///< [N/m], positive
  double damping = 0;    ///< [N s/m], not negative
};

/// Plain wales and wales of lace in turn, from the left edge on, at least one of either. Loops of
/// lace are longer and give more.
struct KnitPattern {
  int plain_columns = 6;
  int lace_columns = 4;
  double lace_stiffness = 0.6;  ///< stiffness of springs within lace over plain ones, positive

  bool is_lace(int column) const {
    return column % (plain_columns + lace_columns) >= plain_columns;
  }
};

/// Knitted cloth as particles of equal mass on a flat grid, joined by springs to their neighbours
/// (structural: warp along the wales, weft along the courses), across both diagonals (shear) and to
/// every second particle of their row and column (bending). A spring is as stiff as the mean of
/// what its ends' wales ask for; dampers are everywhere alike. Its parts are those of a sheet.
/// Source: docs/methods/wool.md.
class KnitCloth final : public ClothSource {
 public:
  SheetShape shape{.columns = 23, .rows = 23};  ///< a particle in each corner of its cells
  double particle_mass = 1e-3;                  ///< [kg], positive
  KnitSpring structural{10000, 0.5};
  KnitSpring shear{4000, 0.5};
  KnitSpring bending{900, 0.7};
  KnitPattern pattern;
  Vec3 initial_velocity{0, 0, 0};  ///< [m/s]

  const char* key() const override { return "knit"; }
  Json json() const override;
  std::int64_t n_vertices(int) const override {
    return (std::int64_t{shape.columns} + 1) * (shape.rows + 1);
  }
  RestCloth at_rest(int level) const override;
  double rest_diagonal() const override { return std::hypot(shape.width, shape.height); }
  bool is_surface() const override { return false; }
  std::string read_part(const JsonReader& reader) const override { return read_sheet_part(reader); }
  std::vector<VertexId> base_part(const std::string& name) const override {
    return sheet_part(shape, name);
  }
};

/// The section "knit" of a scene's cloth.
KnitCloth read_knit(const JsonReader& reader);

}  // namespace pleat
