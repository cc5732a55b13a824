#pragma once

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

  const char* key() const override;
  Json json() const override;
  std::int64_t n_vertices(int level) const override;
  RestCloth at_rest(int level) const override;
  double rest_diagonal() const override;
  bool is_surface() const override { return false; }
  std::string read_part(const JsonReader& reader) const override;
  std::vector<VertexId> base_part(const std::string& name) const override;
};

/// The section "particles" of a scene's cloth.
ParticleCloth read_particles(const JsonReader& reader);

}  // namespace pleat
