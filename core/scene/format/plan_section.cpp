#include "core/scene/format/plan_section.h"

#include "core/base/check.h"
#include "core/files/plan_file.h"
#include "core/scene/rest_cloth.h"

namespace pleat {

RefinementPlan read_scene_plan(const JsonReader& reader, const FileSource& files,
                               const Scene& scene) {
  const auto base = base_quads(scene);
  if (!base) reader.fail("no plan, as only a sheet or a garment is refined by one");
  if (scene.model.elasticity == Elasticity::membrane)
    reader.fail("no plan with a membrane, as only springs hold hanging vertices");
  const bool is_file = reader.is_text();
  if (is_file && !files) reader.fail("a plan written out, as no files can be read here");
  const auto checked = [&base](RefinementPlan plan) {
    planned_mesh(*base, plan);
    return plan;
  };
  if (is_file)
    return read_named_file(reader, files,
                           [&](const std::string& text) { return checked(read_plan(text)); });
  try {
    return checked(read_plan(reader));
  } catch (const InputError& error) {
    if (error.where().rfind(reader.pointer(), 0) == 0) throw;
    throw InputError(reader.pointer() + error.where(), error.what());
  }
}

}  // namespace pleat
