#include "core/scene/format/cloth_section.h"

#include "core/base/check.h"

namespace pleat {

void check_level(const Scene& scene, int level, const std::string& where) {
  if (level > 0 && !scene.cloth->is_surface())
    throw InputError(where,
                     "expected 0, as particles cannot be refined, got " + std::to_string(level));
  const std::int64_t n_vertices = scene.cloth->n_vertices(level);
  if (n_vertices > kMaxVertices)
    throw InputError(where, "expected a level with at most " + std::to_string(kMaxVertices) +
                                " vertices, got " + std::to_string(level) + " with " +
                                std::to_string(n_vertices));
}

void read_cloth(const JsonReader& reader, const FileSource& files, std::span<const ClothKind> kinds,
                Scene& scene) {
  std::vector<const char*> keys;
  for (const ClothKind& kind : kinds) keys.push_back(kind.key);
  reader.allow_keys(keys);
  const ClothKind& kind = kinds[reader.only_one_of(keys)];
  scene.cloth = kind.read(reader.at(kind.key), {files, scene.body.get()});
}

Json json_cloth(const Scene& scene) {
  Json json;
  json[scene.cloth->key()] = scene.cloth->json();
  return json;
}

}  // namespace pleat
