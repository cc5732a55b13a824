#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/fabric/spring_lattice.h"
#include "core/files/json_reader.h"
#include "core/mesh/quad_mesh.h"
#include "core/mesh/triangle_mesh.h"
#include "core/mesh/vertex_group.h"

namespace pleat {

/// Masses and springs that cloth has of its own, so that it needs no fabric.
struct GivenSprings {
  Eigen::VectorXd masses;  ///< [kg], positive, one per vertex
  std::vector<Spring> springs;
  std::vector<BendElement> bends;
};

/// The cloth of a scene before it moves.
struct RestCloth {
  std::optional<QuadMesh> quads;     ///< set where cloth is made of quads
  TriangleMesh mesh;                 ///< triangles of any cloth; particles have no warp directions
  std::vector<VertexGroup> groups;   ///< parts that pins may name
  RestCoordinates rest_coordinates;  ///< 2 x n [m], or empty; a mesh's texture coordinates
  Positions start;                   ///< start [m]: at rest, a garment as it is round
  Positions start_velocities;        ///< 3 x n [m/s]
  std::optional<GivenSprings> given_springs;  ///< springs of particles and knits
};

class QuadCloth;

/// The cloth of a scene as its file describes it. Each kind of cloth is one class; what else
/// a program does with cloth asks here and does not know the kind.
class ClothSource {
 public:
  virtual ~ClothSource() = default;

  /// The key of the section "cloth" that names the kind.
  virtual const char* key() const = 0;
  /// The value of that key with every default and every mesh written out.
  virtual Json json() const = 0;

  /// Vertices after `level` uniform refinements, counted without making them.
  virtual std::int64_t n_vertices(int level) const = 0;
  /// Refined uniformly, 0 to kMaxLevel times; 0 where is_surface() is false.
  virtual RestCloth at_rest(int level) const = 0;
  /// Remark of its reader, a sentence; mostly empty.
  virtual std::string remark() const { return {}; }
  /// Length that position errors are given in per cent of [m]: a sheet's diagonal, or that of the
  /// box around other cloth. 0 for a single vertex.
  virtual double rest_diagonal() const = 0;

  /// This cloth when it is made of quads, which springs and plans need; else null.
  virtual const QuadCloth* quads() const { return nullptr; }
  /// True for one piece with an area: a membrane may fill it, it can be refined, and a hand holds
  /// what is near. False for particles and knits.
  virtual bool is_surface() const { return true; }
  /// True for what is fixed to a body's waist and meets its hips and legs alone.
  virtual bool is_worn() const { return false; }

  /// The name of a part that a pin gives. Throws InputError for a name that no part has.
  virtual std::string read_part(const JsonReader& reader) const = 0;
  /// The unrefined vertices of a part that read_part returned, ascending.
  virtual std::vector<VertexId> base_part(const std::string& name) const = 0;
};

/// Cloth made of quads, which can be refined in any way.
class QuadCloth : public ClothSource {
 public:
  virtual QuadMesh base_quads() const = 0;
  /// The cloth on quads that refine base_quads().
  virtual RestCloth at_rest(QuadMesh quads) const = 0;

  std::int64_t n_vertices(int level) const override;
  RestCloth at_rest(int level) const final;
  const QuadCloth* quads() const final { return this; }
};

/// The cloth at rest on its quads, without groups and not moving.
RestCloth flat_rest_cloth(QuadMesh quads);

/// A cloth of any kind. Copies share it, as it never changes.
class SceneCloth {
 public:
  /// Takes a cloth of one kind.
  template <class Kind, class = std::enable_if_t<std::is_base_of_v<ClothSource, Kind>>>
  SceneCloth(Kind cloth)  // NOLINT(google-explicit-constructor): a cloth is a scene's cloth
      : source_(std::make_shared<const Kind>(std::move(cloth))) {}

  const ClothSource* operator->() const { return source_.get(); }
  const ClothSource& operator*() const { return *source_; }

  /// The cloth when it is of this kind, else null: for a question about one kind alone.
  template <class Kind>
  const Kind* as() const {
    return dynamic_cast<const Kind*>(source_.get());
  }

 private:
  std::shared_ptr<const ClothSource> source_;
};

}  // namespace pleat
