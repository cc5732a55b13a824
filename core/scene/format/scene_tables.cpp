#include "core/scene/format/scene_tables.h"

#include <array>

#include "core/scene/cloth/garment_cloth.h"
#include "core/scene/cloth/knit_cloth.h"
#include "core/scene/cloth/obj_cloth.h"
#include "core/scene/cloth/particle_cloth.h"
#include "core/scene/sheet_cloth.h"

namespace pleat {
namespace {

using Around = const ClothSurroundings&;

constexpr std::array<ClothKind, 5> kCloths{{
    {"sheet", [](const JsonReader& at, Around) -> SceneCloth { return read_sheet(at); }},
    {"particles", [](const JsonReader& at, Around) -> SceneCloth { return read_particles(at); }},
    {"knit", [](const JsonReader& at, Around) -> SceneCloth { return read_knit(at); }},
    {"mesh",
     [](const JsonReader& at, Around around) -> SceneCloth {
       return read_mesh_cloth(at, around.files);
     }},
    {"garment",
     [](const JsonReader& at, Around around) -> SceneCloth {
       return read_garment(at, around.body);
     }},
}};

}  // namespace

std::span<const ClothKind> standard_cloths() { return kCloths; }

}  // namespace pleat
