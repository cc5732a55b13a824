#include <cmath>
#include <cstdio>
#include <memory>

#include "cli/command_table.h"
#include "cli/overwriting.h"
#include "cli/progress.h"
#include "cli/scene_input.h"
#include "core/base/check.h"
#include "core/scene/format/scene_file.h"
#include "core/sweep/sweep_reference.h"

namespace pleat {
namespace {

constexpr double kUsualStep = 1.0 / 960;  // [s]

ReferenceKind take_kind(Arguments& arguments) {
  const std::string kind = arguments.text("--kind").value_or("same_mesh");
  if (kind == "same_mesh") return ReferenceKind::same_mesh;
  if (kind == "converged") return ReferenceKind::converged;
  throw InputError("--kind", "expected same_mesh or converged, got " + abbreviated(Json(kind)));
}

/// Multiples of `every` [s] up to the scene's end.
std::vector<double> sample_times(const Scene& scene, double every) {
  constexpr double kRounding = 1e-9;  // of a sample
  constexpr double kMaxSamples = 100'000;
  const double n = std::floor(scene.duration / every + kRounding);
  if (n < 1 || n > kMaxSamples)
    throw InputError("--every",
                     "expected a time that fits 1 to 100000 times into the duration of " +
                         Json(scene.duration).dump() + " s, got " + Json(every).dump());
  std::vector<double> times;
  for (int k = 1; k <= static_cast<int>(n); ++k) times.push_back(k * every);
  return times;
}

/// How well it is known, in ten lines at most.
void print_reference(const Reference& reference) {
  std::printf("%s: %s\n%s\n", reference.label.id.c_str(), reference.label.description.c_str(),
              "time s   known to mm");
  const std::size_t n = reference.samples.size();
  for (std::size_t k = 1; k <= 10; ++k) {
    const std::size_t s = k * n / 10;
    if (s == 0 || s == (k - 1) * n / 10) continue;
    const Sample& sample = reference.samples[s - 1];
    std::printf("%-8.4g %.3g\n", sample.time, 1e3 * sample.uncertainty);
  }
}

ReferenceRecipe recipe_of(ReferenceKind kind, const Scene& scene,
                          const std::vector<double>& times) {
  return {reference_id(id_prefix(kind), scene, times), kind, scene, {}};
}

Reference made(const ReferenceRecipe& recipe, const std::vector<double>& times,
               const Reference* coarser = nullptr) {
  const std::unique_ptr<ReferenceMaker> maker = make_reference_maker(recipe, times, coarser);
  finish(*maker, recipe.scene.name + ", level " + std::to_string(recipe.scene.level));
  return maker->reference();
}

Reference made(ReferenceKind kind, const Scene& scene, const std::vector<double>& times) {
  ReferenceRecipe recipe = recipe_of(kind, scene, times);
  if (kind == ReferenceKind::same_mesh) return made(recipe, times);
  if (scene.level == 0)
    throw InputError("/refinement/level",
                     "expected at least 1, as the mesh is to be halved, got 0");
  Scene coarser = scene;
  --coarser.level;
  const Reference below = made(recipe_of(ReferenceKind::same_mesh, coarser, times), times);
  recipe.coarser = 0;
  return made(recipe, times, &below);
}

/// With the vertices of one of its coarser meshes alone.
void keep_level(Reference& reference, const Scene& scene, int level) {
  if (level > scene.level)
    throw InputError("--keep-level", "expected at most the level of the run, " +
                                         std::to_string(scene.level) + ", got " +
                                         std::to_string(level));
  thin(reference, scene.cloth->n_vertices(level));
}

Outcome reference_command(Arguments arguments) {
  const ReferenceKind kind = take_kind(arguments);
  const auto out = arguments.text("--out");
  Overwriting overwriting(arguments);
  const auto every_text = arguments.text("--every");
  const double every =
      every_text ? parse_positive_number(*every_text, "--every") : RecordOptions{}.every;
  for (const char* option : {"--stepper", "--substeps", "--iterations", "--solver", "--tolerance"})
    arguments.refuse(option, "a reference is made by newton with the midpoint rule");
  const auto kept_level = arguments.whole_number("--keep-level", 0, kMaxLevel);
  const SceneInput input = take_scene(arguments);
  arguments.finish();
  Scene scene = input.scene;
  const double step = input.is_set_by("--step") ? input.scene.method.step : kUsualStep;
  if (step > every)
    throw InputError("--step", "expected at most the " + Json(every).dump() +
                                   " s between two samples, got " + Json(step).dump());
  scene.method = exact_method(step);
  const std::vector<double> times = sample_times(input.scene, every);
  overwriting.need(out.has_value(), "--out");
  overwriting.spare(input.files_read);
  if (out) overwriting.check(*out);
  Reference reference = with_source_named(input, [&] { return made(kind, scene, times); });
  if (kept_level) keep_level(reference, scene, *kept_level);
  print_reference(reference);
  if (reference.samples.empty()) return Outcome::check_failed;
  if (out) write_file(*out, write_reference(reference, Precision::float32));
  return Outcome::ok;
}

}  // namespace

extern const Command kReferenceCommand(
    "reference", "SCENE.json", "make a reference by newton and tell how well it is known",
    reference_command, {kFabricHelp, kTimeHelp, kOverwriteHelp},
    R"(  --kind KIND            same_mesh (default): halve its step; converged: halve its step and its mesh
  --step S               of it (default 1/960 s);  --every S  of its samples (default 1/60 s)
  --level N              of its mesh;  --keep-level N  keep the vertices of this coarser one alone
  --out FILE             keep it, with 32-bit positions
)");

}  // namespace pleat
