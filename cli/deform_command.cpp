#include <algorithm>
#include <cstdio>

#include "cli/command_table.h"
#include "cli/deform_input.h"
#include "cli/overwriting.h"
#include "cli/scene_input.h"
#include "core/base/core_version.h"
#include "core/files/obj_file.h"

namespace pleat {
namespace {

/// A solved scene.
struct Deformation {
  DeformSolver solver;
  DeformTerms start = solver.terms();  ///< when what is held was moved, before the first step
  SolveReport report = solver.solve();

  /// How far a vertex has gone at most from its place at rest [m].
  double farthest(const DeformScene& scene) const {
    return (solver.positions() - scene.mesh.rest_positions).colwise().norm().maxCoeff();
  }
};

/// A warning about the shape that these weights have; mostly none.
std::string caution(const DeformWeights& weights) {
  if (weights.recovery > 0 || weights.bending > 0) return "";
  return "stretch alone resists no bending: where cloth is not taut it crumples at no cost, and "
         "this is one of many shapes";
}

std::string fabric_name(const DeformScene& scene) {
  if (!scene.fabric.empty()) return scene.fabric;
  return scene.fit ? "own measurements" : "own weights";
}

Json json_fit(const FittedWeights& fit, const FabricLibrary& fabrics) {
  return {{"normalised", json_three(fit.normalised)},
          {"leave_one_out_error", json_three(fit.leave_one_out_error)},
          {"clamped", fit.clamped},
          {"nearest_fabric", fabrics.fabrics[fit.nearest].name},
          {"distance", fit.distance}};
}

Json json_steps(const std::vector<DeformStep>& steps) {
  Json json = Json::array();
  for (const DeformStep& step : steps)
    json.push_back({{"energy", step.energy},
                    {"terms", json_three(step.terms)},
                    {"relative_step", step.relative_step},
                    {"halvings", step.halvings},
                    {"linearised", step.linearised},
                    {"damping", step.damping}});
  return json;
}

Json json_deformation(const DeformScene& scene, const Deformation& result,
                      const FabricLibrary& fabrics) {
  const DeformWeights weights = scene.weights();
  Json json = {
      {"scene", scene.name},
      {"fabric", fabric_name(scene)},
      {"weights", json_three(weights)},
      {"form", name(scene.form)},
      {"n_vertices", scene.mesh.n_vertices()},
      {"n_triangles", scene.mesh.triangles.size()},
      {"n_edges", mesh_edges(scene.mesh.triangles).size()},
      {"n_held", result.solver.held().size()},
      {"status", name(result.report.status)},
      {"message", result.report.message},
      {"linearisations", result.report.iterations},
      {"begin", {{"energy", result.start.weighted(weights)}, {"terms", json_three(result.start)}}},
      {"steps", json_steps(result.solver.steps())},
      {"farthest_m", result.farthest(scene)}};
  if (result.report.ok()) json["minimum"] = "local";
  if (!caution(weights).empty()) json["caution"] = caution(weights);
  if (scene.fit) json["fit"] = json_fit(*scene.fit, fabrics);
  json["core"] = core_version();
  return json;
}

void print_fit(const FittedWeights& fit, const FabricLibrary& fabrics) {
  const GeometricMeasures& error = fit.leave_one_out_error;
  std::printf("from measurements: leave-one-out error %.2f, %.2f, %.2f; nearest fabric %s\n",
              error.recovery, error.stretch, error.bending,
              printable(fabrics.fabrics[fit.nearest].name).c_str());
  for (const MeasureField& measure : kMeasures)
    if (std::count(fit.clamped.begin(), fit.clamped.end(), measure.name) > 0)
      std::printf("%s lies outside of what was measured, %.4g to %.4g, and was taken at its end\n",
                  std::string(measure.name).c_str(), fit.measured_low.*measure.value,
                  fit.measured_high.*measure.value);
}

void print_deformation(const DeformScene& scene, const Deformation& result,
                       const FabricLibrary& fabrics) {
  const DeformWeights weights = scene.weights();
  std::printf("%s: %s, %s, %d vertices, %zu triangles, %zu edges, %zu held\n",
              printable(scene.name).c_str(), printable(fabric_name(scene)).c_str(),
              name(scene.form), scene.mesh.n_vertices(), scene.mesh.triangles.size(),
              mesh_edges(scene.mesh.triangles).size(), result.solver.held().size());
  std::printf("weights: recovery %.4g, stretch %.4g, bending %.4g\n", weights.recovery,
              weights.stretch, weights.bending);
  if (!caution(weights).empty()) std::printf("%s\n", caution(weights).c_str());
  if (scene.fit) print_fit(*scene.fit, fabrics);
  std::printf("step  energy       recovery     stretch      bending      relative step\n");
  std::printf("%4d  %-11.5g  %-11.5g  %-11.5g  %-11.5g\n", 0, result.start.weighted(weights),
              result.start.recovery, result.start.stretch, result.start.bending);
  int n = 0;
  for (const DeformStep& step : result.solver.steps())
    std::printf("%4d  %-11.5g  %-11.5g  %-11.5g  %-11.5g  %.2g%s\n", ++n, step.energy,
                step.terms.recovery, step.terms.stretch, step.terms.bending, step.relative_step,
                step.linearised ? " linearised" : "");
  std::printf("status %s, %zu steps, %d linearisations, farthest from rest %.4g m\n",
              name(result.report.status), result.solver.steps().size(), result.report.iterations,
              result.farthest(scene));
  if (result.report.ok())
    std::printf("nothing around this shape has less energy; from another start, one might\n");
  if (!result.report.message.empty()) std::printf("%s\n", result.report.message.c_str());
}

Outcome deform_command(Arguments arguments) {
  const bool for_machines = arguments.flag("--json");
  const bool checks = arguments.flag("--check");
  const auto out = arguments.text("--out");
  Overwriting overwriting(arguments);
  const DeformInput input = take_deform_scene(arguments);
  const DeformScene& scene = input.scene;
  overwriting.need(out.has_value(), "--out");
  overwriting.spare(input.files_read);
  if (out) overwriting.check(*out);
  const Deformation result =
      with_source_named(input, [&] { return Deformation{held_solver(scene)}; });
  if (for_machines)
    std::printf("%s\n", json_deformation(scene, result, input.fabrics).dump().c_str());
  else
    print_deformation(scene, result, input.fabrics);
  if (!result.report.ok())
    std::fprintf(stderr, "pleat: %snot at the least energy: %s\n",
                 result.report.ends_run() ? "" : "warning: ", result.report.message.c_str());
  if (result.report.ends_run()) return Outcome::check_failed;
  if (out)
    write_file(*out, write_obj({result.solver.positions(),
                                scene.mesh.triangles,
                                scene.textures,
                                scene.groups,
                                {},
                                {}}));
  return checks && !result.report.ok() ? Outcome::check_failed : Outcome::ok;
}

}  // namespace

extern const Command kDeformCommand(
    "deform", "SCENE.json | MESH.obj",
    "the shape of least energy of cloth that is pinned and pulled", deform_command,
    {kDeformHelp, kOverwriteHelp, kJsonHelp},
    R"(  --out FILE.obj         write the shape with the mesh's texture coordinates and groups
  --check                exit status 1 when there is a warning: it stopped short of the least energy
)");

}  // namespace pleat
