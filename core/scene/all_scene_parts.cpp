#include <string_view>

#include "core/scene/bone_word.h"
#include "core/scene/garment_cloth.h"
#include "core/scene/obj_cloth.h"
#include "core/scene/plan_section.h"
#include "core/scene/scene_parts.h"
#include "core/scene/start_section.h"
#include "core/scene/tearing.h"

namespace pleat {
namespace {

SceneCloth garment(const JsonReader& reader, const ClothSurroundings& around) {
  return read_garment(reader, around.figure);
}

SceneCloth mesh(const JsonReader& reader, const ClothSurroundings& around) {
  return read_mesh_cloth(reader, around.files);
}

void register_kind(SceneParts& parts, const SceneParts::ClothKind& kind) {
  for (SceneParts::ClothKind& known : parts.cloths)
    if (std::string_view(known.key) == kind.key) known = kind;
}

}  // namespace

SceneParts scene_parts_with_files() {
  SceneParts parts = plain_scene_parts();
  register_kind(parts, {"mesh", mesh});
  return parts;
}

SceneParts worn_scene_parts() {
  SceneParts parts = plain_scene_parts();
  register_kind(parts, {"garment", garment});
  parts.read_figure = read_figure;
  parts.read_plan = read_scene_plan;
  parts.read_bone = read_bone;
  parts.read_start = read_start;
  return parts;
}

SceneParts all_scene_parts() {
  SceneParts parts = worn_scene_parts();
  register_kind(parts, {"mesh", mesh});
  parts.read_tearing = read_tearing;
  parts.read_start = read_start_or_obj;
  return parts;
}

}  // namespace pleat
