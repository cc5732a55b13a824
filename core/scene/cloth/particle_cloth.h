#pragma once

#include "core/base/check.h"
#include "core/scene/cloth_source.h"

namespace pleat {

/// Particles and springs written out in the scene: textbook systems (pendulum, chain) are scenes
/// too.
class ParticleCloth final : public ClothSource {
 public:
  Positions positions;     ///< positions at time 0 [m]
  Positions velocities;    ///< velocities at time 0 [m/s], same size
  Eigen::VectorXd masses;  ///< [kg], positive
  std::vector<Spring> springs;
  std::vector<BendElement> bends;
  std::vector<Triangle> triangles;  ///< faces for drawing and air drag; may be empty

  const char* key() const override { return "particles"; }
  Json json() const override;
  std::int64_t n_vertices(int) const override { return positions.cols(); }
  RestCloth at_rest(int level) const override;
  double rest_diagonal() const override {
    return positions.cols() == 0 ? 0 : box_diagonal(positions);
  }
  bool is_surface() const override { return false; }
  std::string read_part(const JsonReader& reader) const override {
    reader.fail("listed vertices or a box, as particles have no parts");
  }
  std::vector<VertexId> base_part(const std::string&) const override {
    throw ContractError("particles have no parts");
  }
};

/// The section "particles" of a scene's cloth.
ParticleCloth read_particles(const JsonReader& reader);

}  // namespace pleat
