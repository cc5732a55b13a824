#include "core/measure/reference.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "core/base/check.h"
#include "core/measure/core_version.h"
#include "core/scene/json_reader.h"
#include "core/scene/scene_file.h"

namespace pleat {
namespace {

std::uint64_t fnv_1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
  return hash;
}

/// The scene without what moves no vertex; a library's fabric as its numbers, which may change.
Scene moving_part(Scene scene) {
  const Scene unset;
  scene.name = unset.name;
  scene.caption = unset.caption;
  scene.duration = unset.duration;
  scene.record = unset.record;
  scene.fabric_is_named = false;
  return scene;
}

Json header_json(const Reference& reference) {
  Json samples = Json::array();
  for (const Sample& sample : reference.samples)
    samples.push_back(Json{{"time_s", sample.time},
                           {"n_vertices", sample.positions.cols()},
                           {"rms_stretch", sample.stretch.rms},
                           {"largest_stretch", sample.stretch.largest}});
  return {{"id", reference.label.id},
          {"description", reference.label.description},
          {"converged", reference.label.converged},
          {"samples", samples}};
}

/// n_bytes  that follow the header: what they cannot fill is not allocated
Reference read_header(const Json& json, std::size_t n_bytes) {
  constexpr std::int64_t kMostVertices = 100'000'000;
  auto n_left = static_cast<std::int64_t>(n_bytes / (3 * sizeof(double)));  // vertices
  const JsonReader header(json);
  header.allow_keys({"id", "description", "converged", "samples"});
  Reference reference;
  reference.label = {header.at("id").text(), header.at("description").text(),
                     header.at("converged").boolean()};
  if (reference.label.id.empty()) header.at("id").fail("an id");
  for (const JsonReader& entry : header.at("samples").elements()) {
    Sample sample{entry.at("time_s").number(kPositive), {}, {}};
    const std::int64_t n_vertices = entry.at("n_vertices").integer(1, kMostVertices);
    if (n_vertices > n_left) throw InputError("", "the reference's positions are cut short");
    n_left -= n_vertices;
    sample.positions.resize(3, n_vertices);
    sample.stretch = {entry.at("rms_stretch").number(kNotNegative),
                      entry.at("largest_stretch").number(kNotNegative)};
    reference.samples.push_back(std::move(sample));
  }
  return reference;
}

}  // namespace

std::string step_phrase(double step) {
  constexpr double kRounding = 1e-9;  // relative; what 1/n written in 15 digits has
  const double per_second = 1 / step;
  const bool is_whole_part = std::abs(std::round(per_second) - per_second) < kRounding * per_second;
  char text[32];
  if (is_whole_part && per_second > 0.5)
    std::snprintf(text, sizeof text, "1/%.0f s", per_second);
  else
    std::snprintf(text, sizeof text, "%.3g s", step);
  return text;
}

std::string content_hash(std::string_view bytes) {
  constexpr char kDigits[] = "0123456789abcdef";
  const std::uint64_t hash = fnv_1a(bytes);
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[(hash >> shift) & 0xF];
  return text;
}

std::string reference_id(std::string_view prefix, const Scene& scene,
                         std::span<const double> times) {
  std::string content = core_version();
  content.append("\n").append(write_scene(moving_part(scene)));
  for (const double time : times) content.append("\n").append(Json(time).dump());
  return std::string(prefix) + "-" + content_hash(content);
}

std::optional<Reference> MemoryReferenceStore::find(const std::string& id) {
  const auto place = references_.find(id);
  if (place == references_.end()) return std::nullopt;
  return place->second;
}

void MemoryReferenceStore::keep(const Reference& reference) {
  references_[reference.label.id] = reference;
}

std::string write_reference(const Reference& reference) {
  std::string bytes = header_json(reference).dump() + "\n";
  for (const Sample& sample : reference.samples)
    bytes.append(reinterpret_cast<const char*>(sample.positions.data()),
                 static_cast<std::size_t>(sample.positions.size()) * sizeof(double));
  return bytes;
}

Reference read_reference(std::string_view bytes) {
  const std::size_t line = std::min(bytes.find('\n'), bytes.size());
  std::size_t at = std::min(line + 1, bytes.size());
  Reference reference = read_header(parse_json(bytes.substr(0, line)), bytes.size() - at);
  for (Sample& sample : reference.samples) {
    const std::size_t size = static_cast<std::size_t>(sample.positions.size()) * sizeof(double);
    std::memcpy(sample.positions.data(), bytes.data() + at, size);
    at += size;
  }
  if (at != bytes.size()) throw InputError("", "the reference has bytes after its positions");
  return reference;
}

}  // namespace pleat
