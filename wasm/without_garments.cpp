// What modules without garments have in the place of them, of plans and of a scene's figure: linked
// before the core's libraries, it keeps those out of what a visitor fetches. A scene that asks for
// one is refused, so that nothing else here is ever reached.
#include "core/base/check.h"
#include "core/files/plan_file.h"
#include "core/mesh/smooth_surface.h"
#include "core/scene/garment_cloth.h"
#include "core/scene/plan_section.h"
#include "core/scene/scene_figure.h"

namespace pleat {
namespace {

[[noreturn]] void refuse(const JsonReader& reader, const char* what) {
  throw InputError(reader.pointer(), std::string("expected no ") + what +
                                         ", as this view shows none; pleat run takes it");
}

[[noreturn]] void unreachable() { throw ContractError("a scene without a figure asks for one"); }

}  // namespace

Figure read_figure(const JsonReader& reader, const FileSource&) { refuse(reader, "figure"); }
Json json_figure(const Figure&) { unreachable(); }

GarmentCloth read_garment(const JsonReader& reader, const Scene&) { refuse(reader, "garment"); }
Json json_garment(const GarmentCloth&) { unreachable(); }

RefinementPlan read_scene_plan(const JsonReader& reader, const FileSource&, const Scene&) {
  refuse(reader, "plan");
}
Json json_plan(const RefinementPlan&) { unreachable(); }
QuadMesh planned_mesh(const QuadMesh&, const RefinementPlan&) { unreachable(); }

Positions on_smooth_surface(const QuadMesh&, const QuadMesh&) { unreachable(); }

std::vector<BodyPart> mannequin(BodyBuild) { unreachable(); }
std::vector<BodyPart> below_waist(std::vector<BodyPart>) { unreachable(); }

}  // namespace pleat
