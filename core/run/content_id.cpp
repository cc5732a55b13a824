#include "core/run/content_id.h"

#include <cstdint>

#include "core/files/json_text.h"
#include "core/scene/format/scene_file.h"

namespace pleat {
namespace {

std::uint64_t fnv_1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
  return hash;
}

}  // namespace

std::string content_hash(std::string_view bytes) {
  constexpr char kDigits[] = "0123456789abcdef";
  const std::uint64_t hash = fnv_1a(bytes);
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[(hash >> shift) & 0xF];
  return text;
}

Scene moving_part(Scene scene) {
  const Scene unset;
  scene.name = unset.name;
  scene.caption = unset.caption;
  scene.duration = unset.duration;
  scene.record = unset.record;
  scene.fabric_is_named = false;
  return scene;
}

std::string content_id(const Scene& scene) {
  Json content = parse_json(write_scene(moving_part(scene)));
  content.erase("refinement");
  content.erase("method");
  return content_hash(content.dump());
}

}  // namespace pleat
