#include <algorithm>
#include <cstdio>
#include <utility>

#include "cli/command_table.h"
#include "cli/overwriting.h"
#include "cli/plan_options.h"
#include "cli/progress.h"
#include "cli/scene_input.h"
#include "core/files/plan_file.h"

namespace pleat {
namespace {

constexpr int kUsualFineLevel = 2;  // an example's, where neither it nor --level says one

/// The option that sets what the planner names.
constexpr std::pair<const char*, const char*> kOptions[] = {{"detail demand", "--demand"},
                                                            {"vertex budget", "--vertices"},
                                                            {"level cap", "--cap"},
                                                            {"number of patterns", "--patterns"}};

/// The first example and all of them.
struct RefineInput : SceneInput {
  std::vector<SceneInput> examples;

  [[noreturn]] void throw_named(const InputError& error) const {
    for (const auto& [name, option] : kOptions)
      if (error.where() == name) throw InputError(option, error.sentence());
    const auto* of_example = dynamic_cast<const ExampleError*>(&error);
    examples[of_example != nullptr ? of_example->example() : 0].throw_named(error);
  }
};

void print_plan(const RefinementPlan& plan, const PlanCost& cost, const Scene& scene) {
  std::vector<int> n_base(static_cast<std::size_t>(plan.n_patterns), 0);
  for (const int pattern : plan.patterns) ++n_base[static_cast<std::size_t>(pattern)];
  std::printf("pattern  base vertices  mean 1/m  deviation 1/m\n");
  const BendFeatures& centres = plan.examples.front().centres;
  for (int p = 0; p < plan.n_patterns; ++p)
    std::printf("%7d  %13d  %8.3g  %13.3g\n", p, n_base[static_cast<std::size_t>(p)], centres(0, p),
                centres(1, p));
  const auto [least, most] =
      std::minmax_element(plan.curvature_limits.begin(), plan.curvature_limits.end());
  std::printf("faces may bend by %.3g to %.3g 1/m\n", *least, *most);
  Scene fine = scene;
  fine.plan.reset();
  const auto n_fine = rest_cloth(fine).mesh.n_vertices();
  const auto n_balance = std::count_if(plan.splits.begin(), plan.splits.end(),
                                       [](const PlannedSplit& split) { return split.for_balance; });
  std::printf("%zu faces split, %lld of them for balance: %d vertices, %.1f %% of %d\n",
              plan.splits.size(), static_cast<long long>(n_balance), plan.n_vertices,
              100.0 * plan.n_vertices / n_fine, n_fine);
  std::printf("%d frames of %.4g s: %.1f s to run, %.2f s to plan, %.0f MB\n", cost.n_frames,
              cost.frame_time, cost.example_seconds, cost.planning_seconds, cost.megabytes);
}

Outcome refine_command(Arguments arguments) {
  const auto out = arguments.text("--out");
  const auto start = arguments.number("--from", Numbers::not_negative);
  PlanRecipe recipe = take_plan_recipe(arguments);
  recipe.patterns.normalised = !arguments.flag("--raw-features");
  if (const auto text = arguments.text("--demand")) set_demand(recipe.plan, *text);
  recipe.plan.max_vertices = arguments.whole_number("--vertices", 1, kMaxVertices);
  Overwriting overwriting(arguments);
  const std::vector<SceneInput> examples = take_scenes(arguments, arguments.list("--merge"));
  const RefineInput input{examples.front(), examples};
  overwriting.need(out.has_value(), "--out");
  std::vector<Scene> scenes;
  for (const SceneInput& example : examples) {
    overwriting.spare(example.files_read);
    scenes.push_back(example.scene);
    if (scenes.back().level == 0 && !scenes.back().plan && !example.is_set_by("--level"))
      scenes.back().level = kUsualFineLevel;
  }
  recipe.begin = start.value_or(settled_time(scenes.front()));
  if (out) overwriting.check(*out);
  return with_source_named(input, [&] {
    PlanMaker maker(scenes, recipe);
    finish(maker, scenes.front().name);
    for (std::size_t k = 0; k < scenes.size(); ++k)
      tell_warnings(maker.warnings()[k], "example " + quotation(scenes[k].name));
    print_plan(maker.plan(), maker.cost(), scenes.front());
    if (out) write_file(*out, plan_text(maker.plan()));
    return Outcome::ok;
  });
}

}  // namespace

extern const Command kRefineCommand(
    "refine", "EXAMPLE.json", "run it on a fine mesh and plan where its cloth needs one",
    refine_command, {kFabricHelp, kMethodHelp, kTimeHelp, kOverwriteHelp},
    R"(  --level N              of the fine mesh (default 2);  --cap N  finest level of the plan
  --patterns N           kinds of bending to tell apart (default 3)
  --criterion shape      (default) split faces for what they lose of the example's shapes;
                         curvature: for the patterns at their corners
  --demand X             until at most so much is lost, RMS [m] (default 0.002); of curvature:
                         faces whose corners' patterns sum to more (default 3);
  --vertices N           or as many vertices as possible up to this number
  --from S               look from here on (default: when a figure has walked in for 1 s)
  --merge OTHER.json,... further examples of the same cloth
  --raw-features         cluster curvatures as they are, not from 0 to 1
  --out PLAN.json        write the plan, for a scene's "refinement": {"plan": "PLAN.json"}
)");

}  // namespace pleat
