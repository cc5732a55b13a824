#include "core/scene/format/scene_parts.h"

#include "core/base/check.h"
#include "core/scene/cloth/knit_cloth.h"
#include "core/scene/cloth/mesh_cloth.h"
#include "core/scene/cloth/particle_cloth.h"
#include "core/scene/sheet_cloth.h"

namespace pleat {
namespace {

SceneCloth sheet(const JsonReader& reader, const ClothSurroundings&) { return read_sheet(reader); }

SceneCloth particles(const JsonReader& reader, const ClothSurroundings&) {
  return read_particles(reader);
}

SceneCloth knit(const JsonReader& reader, const ClothSurroundings&) { return read_knit(reader); }

SceneCloth mesh(const JsonReader& reader, const ClothSurroundings&) {
  if (reader.only_one_of({"obj", "positions_m"}) == 0)
    reader.at("obj").fail("a mesh written out in the scene, as no files can be read here");
  return read_written_mesh(reader);
}

}  // namespace

SceneParts plain_scene_parts() {
  SceneParts parts;
  parts.cloths = {
      {"sheet", sheet}, {"particles", particles}, {"knit", knit}, {"mesh", mesh}, {"garment"}};
  return parts;
}

void refuse_part(const JsonReader& reader, const char* part) {
  throw InputError(reader.pointer(), std::string("expected no ") + part +
                                         ", as this view shows none; pleat run takes it");
}

}  // namespace pleat
