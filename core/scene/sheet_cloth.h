#pragma once

#include "core/scene/cloth_source.h"

namespace pleat {

/// A flat rectangle of quads. Its parts are its edges and corners (sheet_part_groups).
class SheetCloth final : public QuadCloth {
 public:
  SheetCloth() = default;
  explicit SheetCloth(const SheetShape& its_shape, const Vec3& velocity = {0, 0, 0})
      : shape(its_shape), initial_velocity(velocity) {}

  SheetShape shape;
  Vec3 initial_velocity{0, 0, 0};  ///< [m/s]

  const char* key() const override;
  Json json() const override;
  std::int64_t n_vertices(int level) const override;
  double rest_diagonal() const override;
  QuadMesh base_quads() const override;
  using QuadCloth::at_rest;
  RestCloth at_rest(QuadMesh quads) const override;
  std::string read_part(const JsonReader& reader) const override;
  std::vector<VertexId> base_part(const std::string& name) const override;
};

/// The section "sheet" of a scene's cloth.
SheetCloth read_sheet(const JsonReader& reader);

}  // namespace pleat
