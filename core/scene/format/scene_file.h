#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/files/fabric_file.h"
#include "core/files/file_source.h"
#include "core/scene/format/scene_tables.h"
#include "core/scene/scene.h"

namespace pleat {

class JsonReader;

/// Reads a scene (JSON, schema in scene_schema.json). Unknown keys, wrong types, values out of
/// range and everything that could not run throw InputError with the JSON pointer, what was
/// expected and what was found.
///
/// files   for the meshes that it names. Without it they are refused.
/// tables  the kinds of cloth and the steppers that it may name
Scene read_scene(std::string_view json_text, const FabricLibrary& fabrics,
                 const FileSource& files = {}, const SceneTables& tables = {});

/// Reads a scene that is parsed already, from the root of its own document.
Scene read_scene(const JsonReader& root, const FabricLibrary& fabrics, const FileSource& files = {},
                 const SceneTables& tables = {});

/// Writes the scene with every default and every mesh. read_scene(write_scene(s)) gives s again.
std::string write_scene(const Scene& scene);

/// A week of the fastest step; more is a mistake in the unit.
constexpr std::int64_t kMaxSteps = 1'000'000'000;

/// Throws InputError at /duration_s when `duration` [s] is more than kMaxSteps steps of `step` [s].
void check_duration(double duration, double step);

/// `duration` [s] rounded to whole steps of `step` [s]: at least one, at most kMaxSteps.
std::int64_t whole_steps(double duration, double step);

}  // namespace pleat
