#pragma once

#include <cmath>

#include "core/scene/cloth_source.h"
#include "core/scene/sheet_section.h"

namespace pleat {

/// A flat rectangle of quads. Its parts are its edges and corners (sheet_part_groups).
class SheetCloth final : public QuadCloth {
 public:
  SheetCloth() = default;
  explicit SheetCloth(const SheetShape& its_shape, const Vec3& velocity = {0, 0, 0})
      : shape(its_shape), initial_velocity(velocity) {}

  SheetShape shape;
  Vec3 initial_velocity{0, 0, 0};  ///< [m/s]

  const char* key() const override { return "sheet"; }
  Json json() const override;
  std::int64_t n_vertices(int level) const override;
  double rest_diagonal() const override { return std::hypot(shape.width, shape.height); }
  QuadMesh base_quads() const override { return QuadMesh::sheet(shape); }
  using QuadCloth::at_rest;
  RestCloth at_rest(QuadMesh quads) const override;
  std::string read_part(const JsonReader& reader) const override { return read_sheet_part(reader); }
  std::vector<VertexId> base_part(const std::string& name) const override {
    return sheet_part(shape, name);
  }
};

/// The section "sheet" of a scene's cloth.
SheetCloth read_sheet(const JsonReader& reader);

}  // namespace pleat
