#pragma once

#include <span>

#include "core/dynamics/stepper_table.h"
#include "core/files/file_source.h"
#include "core/scene/cloth_source.h"
#include "core/scene/scene_body.h"

namespace pleat {

/// The parts of a scene that are read before its cloth.
struct ClothSurroundings {
  const FileSource& files;
  const SceneBody* body;  ///< or null
};

/// A kind of cloth that the section "cloth" may name.
struct ClothKind {
  const char* key;  ///< value of ClothSource::key()
  SceneCloth (*read)(const JsonReader& reader, const ClothSurroundings& around);
};

/// All that Pleat has.
std::span<const ClothKind> standard_cloths();

/// The tables from which a scene is read.
struct SceneTables {
  std::span<const ClothKind> cloths = standard_cloths();
  StepperTable steppers = standard_steppers();  ///< steppers that the section "method" may name
};

}  // namespace pleat
