#include <string_view>

#include "core/files/plan_file.h"
#include "core/scene/cloth/garment_cloth.h"
#include "core/scene/cloth/obj_cloth.h"
#include "core/scene/format/bone_word.h"
#include "core/scene/format/plan_section.h"
#include "core/scene/format/scene_parts.h"
#include "core/scene/format/start_section.h"
#include "core/scene/sheet_cloth.h"
#include "core/scene/tearing.h"

namespace pleat {
namespace {

SceneCloth garment(const JsonReader& reader, const ClothSurroundings& around) {
  return read_garment(reader, around.figure);
}

SceneCloth mesh(const JsonReader& reader, const ClothSurroundings& around) {
  return read_mesh_cloth(reader, around.files);
}

constexpr PlanPart kPlans{read_scene_plan, json_plan, planned_mesh};
constexpr StartPart kWrittenStarts{read_start, json_start, begin_at};
constexpr StartPart kStarts{read_start_or_obj, json_start, begin_at};

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

SceneParts worn_scene_parts(StepperTable steppers) {
  const auto sheet = [](const JsonReader& reader, const ClothSurroundings&) -> SceneCloth {
    return read_sheet(reader);
  };
  return {.cloths = {{"sheet", sheet}, {"particles"}, {"knit"}, {"mesh"}, {"garment", garment}},
          .steppers = steppers,
          .read_figure = read_figure,
          .plan = &kPlans,
          .start = &kWrittenStarts,
          .read_bone = read_bone};
}

SceneParts all_scene_parts() {
  SceneParts parts = scene_parts_with_files();
  register_kind(parts, {"garment", garment});
  parts.read_figure = read_figure;
  parts.plan = &kPlans;
  parts.read_bone = read_bone;
  parts.read_tearing = read_tearing;
  parts.start = &kStarts;
  return parts;
}

}  // namespace pleat
