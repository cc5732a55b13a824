#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/deform/deform_energy.h"
#include "core/deform/measure_fit.h"
#include "core/files/fabric_file.h"
#include "core/files/file_source.h"
#include "core/mesh/triangle_mesh.h"
#include "core/mesh/vertex_group.h"

namespace pleat {

/// Vertices that go where they are pulled.
struct DeformHandle {
  std::string name;                ///< no other handle has it
  std::vector<VertexId> vertices;  ///< ascending, each once, at least one
  Positions targets;               ///< one column each [m]
};

/// The terms of the energy that count.
struct DeformTermChoice {
  bool recovery = true;
  bool stretch = true;
  bool bending = true;

  /// The weights, zero for terms that do not count.
  DeformWeights chosen(const DeformWeights& weights) const;
};

/// One cloth under pins and handles, as its file describes it.
struct DeformScene {
  std::string name = "unnamed";
  std::string caption;  ///< one sentence: what to notice
  std::string remark;   ///< sentence from its mesh's reader; mostly empty
  TriangleMesh mesh;    ///< triangles with all warp directions
  std::vector<std::optional<CornerTexture>> textures;  ///< one per triangle
  std::vector<VertexGroup> groups;  ///< a sheet's edges, and the parts grasped at its corners
  std::vector<VertexId> pins;       ///< held where they rest; ascending, each once
  std::vector<DeformHandle> handles;
  std::string fabric;  ///< name in the library; empty when weights or measures are given
  std::optional<FittedWeights> fit;  ///< fit to measures, where they are given
  DeformWeights fabric_weights;      ///< weights of all terms
  DeformTermChoice terms;
  EnergyForm form = EnergyForm::consistent;

  DeformWeights weights() const { return terms.chosen(fabric_weights); }
};

/// The vertices that pins or handles hold.
struct HeldVertices {
  std::vector<VertexId> vertices;  ///< ascending, each once
  Positions targets;               ///< one column each [m]
};
HeldVertices held_vertices(const DeformScene& scene);

/// Reads a deformation (JSON, docs/methods/deform_scenes.md). Unknown keys, wrong types, values out
/// of range and everything that has no one shape of least energy throw InputError with the JSON
/// pointer, what was expected and what was found.
///
/// files  for the mesh that it names. Without it, it is refused.
DeformScene read_deform_scene(std::string_view json_text, const FabricLibrary& fabrics,
                              const FileSource& files = {});

/// Throws InputError at /handles/k for a vertex with two places, and at /pins for a part of the
/// mesh that can move as a whole where no recovery weight brings it back. For handles and weights
/// that have changed since reading.
void check_deform_scene(const DeformScene& scene);

}  // namespace pleat
