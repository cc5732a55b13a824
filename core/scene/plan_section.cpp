#include "core/scene/plan_section.h"

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
  try {
    RefinementPlan plan = is_file ? read_plan(files(reader.text())) : read_plan(reader);
    planned_mesh(*base, plan);
    return plan;
  } catch (const InputError& error) {
    if (is_file) throw InputError(place_in(reader.text(), error.where()), error.what());
    if (error.where().rfind(reader.pointer(), 0) == 0) throw;
    throw InputError(reader.pointer() + error.where(), error.what());
  }
}

}  // namespace pleat
