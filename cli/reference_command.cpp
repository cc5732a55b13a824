#include <cmath>
#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "cli/overwriting.h"
#include "cli/progress.h"
#include "cli/scene_input.h"
#include "core/base/check.h"
#include "core/scene/scene_file.h"
#include "core/sweep/sweep_reference.h"

namespace pleat {
namespace {

constexpr double kUsualStep = 1.0 / 960;  // [s]

ReferenceKind take_kind(Arguments& arguments) {
  const std::string kind = arguments.text("--kind").value_or("same_mesh");
  if (kind == "same_mesh") return ReferenceKind::same_mesh;
  if (kind == "newton") return ReferenceKind::newton;
  throw InputError("--kind", "expected same_mesh or newton, got " + abbreviated(Json(kind)));
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

Reference made(const ReferenceRecipe& recipe, const std::vector<double>& times) {
  const std::unique_ptr<ReferenceMaker> maker = make_reference_maker(recipe, times);
  finish(*maker, recipe.scene.name);
  return maker->reference();
}

}  // namespace

Outcome reference_command(Arguments arguments) {
  const ReferenceKind kind = take_kind(arguments);
  const auto out = arguments.text("--out");
  Overwriting overwriting(arguments);
  const auto every_text = arguments.text("--every");
  const double every =
      every_text ? parse_positive_number(*every_text, "--every") : RecordOptions{}.every;
  for (const char* option : {"--stepper", "--substeps", "--iterations", "--solver", "--tolerance"})
    arguments.refuse(option, "a reference is made by newton with the midpoint rule");
  const SceneInput input = take_scene(arguments);
  arguments.finish();
  ReferenceRecipe recipe{"", kind, input.scene};
  const double step = input.is_set_by("--step") ? input.scene.method.step : kUsualStep;
  recipe.scene.method = exact_method(step);
  const std::vector<double> times = sample_times(input.scene, every);
  recipe.id = reference_id(id_prefix(kind), recipe.scene, times);
  overwriting.need(out.has_value(), "--out");
  overwriting.spare(input.files_read);
  if (out) overwriting.check(*out);
  const Reference reference = with_source_named(input, [&] { return made(recipe, times); });
  print_reference(reference);
  if (reference.samples.empty()) return Outcome::check_failed;
  if (out) write_file(*out, write_reference(reference, Precision::float32));
  return Outcome::ok;
}

}  // namespace pleat
