#pragma once

#include <variant>

#include "core/body/garment_patterns.h"
#include "core/scene/cloth_source.h"
#include "core/scene/scene_body.h"
#include "core/scene/vertex_place.h"

namespace pleat {

/// Quads around the standing body. Its parts are the garment's groups.
class GarmentCloth final : public QuadCloth {
 public:
  std::variant<SkirtMeasures, TrouserMeasures> measures;
  Garment garment;  ///< made from them

  const char* key() const override { return "garment"; }
  /// The measures, from which the quads follow.
  Json json() const override;
  double rest_diagonal() const override { return box_diagonal(garment.patch.rest_positions); }
  QuadMesh base_quads() const override { return QuadMesh::from_patch(garment.patch); }
  using QuadCloth::at_rest;
  RestCloth at_rest(QuadMesh quads) const override;
  bool is_worn() const override { return true; }
  std::string read_part(const JsonReader& reader) const override {
    return read_group(reader, garment.groups).name;
  }
  std::vector<VertexId> base_part(const std::string& name) const override {
    return vertices_of(garment.groups, name);
  }
};

/// The section "garment" of a scene's cloth: measures of a skirt or of trousers for the scene's
/// body. Measures that make no garment are InputErrors at their places.
///
/// body  null when the scene has none; then a garment is refused
GarmentCloth read_garment(const JsonReader& reader, const SceneBody* body);

}  // namespace pleat
