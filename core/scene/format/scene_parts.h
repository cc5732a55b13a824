#pragma once

#include <memory>
#include <vector>

#include "core/dynamics/stepper_table.h"
#include "core/files/file_source.h"
#include "core/scene/cloth_source.h"
#include "core/scene/scene_figure.h"

namespace pleat {

class Tearing;
struct RefinementPlan;
struct StartState;
struct Scene;

/// The parts of a scene that are read before its cloth.
struct ClothSurroundings {
  const FileSource& files;
  const Figure* figure;  ///< or null
};

/// What a program that knows plans of refinement does with one.
struct PlanPart {
  /// The key "plan" of the section "refinement"; the scene has its cloth and model.
  RefinementPlan (*read)(const JsonReader& reader, const FileSource& files, const Scene& scene);
  Json (*write)(const RefinementPlan& plan);
  QuadMesh (*mesh)(const QuadMesh& base, const RefinementPlan& plan);
};

/// The same of states that cloth begins at.
struct StartPart {
  /// The section "start"; the scene has all else.
  StartState (*read)(const JsonReader& reader, const FileSource& files, const Scene& scene);
  Json (*write)(const StartState& start);
  void (*begin)(const StartState& start, const Scene& scene, RestCloth& cloth);
};

/// The parts that a program lets a scene have, and their readers. A program contains the code of
/// the parts that it registers here. A part without a reader is known and refused (refuse_part).
struct SceneParts {
  struct ClothKind {
    const char* key;  ///< in the section "cloth", as ClothSource::key()
    SceneCloth (*read)(const JsonReader& reader, const ClothSurroundings& around) = nullptr;
  };
  std::vector<ClothKind> cloths;
  /// The steppers that the section "method" may name.
  StepperTable steppers = standard_steppers();
  /// The section "figure".
  std::shared_ptr<const Figure> (*read_figure)(const JsonReader& reader,
                                               const FileSource& files) = nullptr;
  const PlanPart* plan = nullptr;
  const StartPart* start = nullptr;
  /// The section "tearing" of the model.
  std::shared_ptr<const Tearing> (*read_tearing)(const JsonReader& reader) = nullptr;
  /// The bone that a pin follows.
  Bone (*read_bone)(const JsonReader& reader) = nullptr;
};

/// Everything.
SceneParts all_scene_parts();

/// Sheets, particles, knits and meshes that are written out, without figures, garments, plans and
/// tearing.
SceneParts plain_scene_parts();

/// The same with meshes of OBJ files.
SceneParts scene_parts_with_files();

/// Sheets and garments, figures, plans and starts, moved by these steppers.
SceneParts worn_scene_parts(StepperTable steppers);

/// Throws the InputError for a part that a program lacks: "garment", say.
[[noreturn]] void refuse_part(const JsonReader& reader, const char* part);

}  // namespace pleat
