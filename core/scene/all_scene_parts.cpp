#include "core/scene/bone_word.h"
#include "core/scene/garment_cloth.h"
#include "core/scene/plan_section.h"
#include "core/scene/scene_parts.h"

namespace pleat {
namespace {

SceneCloth garment(const JsonReader& reader, const ClothSurroundings& around) {
  return read_garment(reader, around.figure);
}

}  // namespace

SceneParts all_scene_parts() {
  SceneParts parts = plain_scene_parts();
  parts.cloths.back() = {"garment", garment};
  parts.read_figure = read_figure;
  parts.read_plan = read_scene_plan;
  parts.read_bone = read_bone;
  return parts;
}

}  // namespace pleat
