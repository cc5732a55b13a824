#include <cstdio>

#include "cli/command_table.h"
#include "cli/deform_input.h"
#include "core/base/core_version.h"
#include "core/error/surface_distance.h"
#include "core/sweep/deform_cost.h"
#include "core/sweep/platform.h"

namespace pleat {
namespace {

Json cost_json(const DeformCost& cost) {
  return {{"total_ms", cost.total_ms},       {"build_ms", cost.build_ms},
          {"assembly_ms", cost.assembly_ms}, {"factor_ms", cost.factor_ms},
          {"solve_ms", cost.solve_ms},       {"linearisations", cost.n_linearisations},
          {"steps", cost.n_steps},           {"energy", cost.energy},
          {"terms", json_three(cost.terms)}, {"status", name(cost.report.status)},
          {"message", cost.report.message}};
}

DeformSolver solved(const DeformScene& scene) {
  DeformSolver solver = held_solver(scene);
  solver.solve();
  return solver;
}

/// Tells how much of the bending is at each vertex.
Json vertices_json(const DeformScene& scene) {
  const DeformSolver solver = solved(scene);
  const Eigen::VectorXd shares = solver.model().bending_shares(solver.positions());
  const Positions& rest = scene.mesh.rest_positions;
  return {{"rest_m", std::vector<double>(rest.data(), rest.data() + rest.size())},
          {"bending", std::vector<double>(shares.data(), shares.data() + shares.size())}};
}

/// The scene of another file under the same weights and form.
DeformScene other_scene(const std::string& file, const DeformScene& like) {
  Arguments arguments({file});
  DeformScene other = take_deform_scene(arguments).scene;
  other.fabric_weights = like.fabric_weights;
  other.terms = like.terms;
  other.form = like.form;
  check_deform_scene(other);
  return other;
}

Json distance_json(const DeformScene& scene, const DeformScene& other) {
  const SurfaceError distance = surface_error(scene.mesh.triangles, solved(scene).positions(),
                                              other.mesh.triangles, solved(other).positions());
  return {{"n_vertices", other.mesh.n_vertices()},
          {"rms_m", distance.rms},
          {"largest_m", distance.largest}};
}

Outcome bench_deform(Arguments arguments) {
  const auto n_moves = arguments.whole_number("--drag", 1, 10'000);
  const auto against = arguments.text("--against");
  const bool wants_vertices = arguments.flag("--vertices");
  const DeformInput input = take_deform_scene(arguments);
  const DeformScene& scene = input.scene;
  const DeformCost cost = with_source_named(input, [&] { return deform_cost(scene); });
  Json json = {{"scene", scene.name},
               {"fabric", scene.fabric},
               {"weights", json_three(scene.weights())},
               {"n_vertices", scene.mesh.n_vertices()},
               {"n_triangles", scene.mesh.triangles.size()},
               {"n_edges", mesh_edges(scene.mesh.triangles).size()},
               {"cost", cost_json(cost)},
               {"target", build_target()},
               {"core", core_version()}};
  if (n_moves) {
    const DragCost drag = with_source_named(input, [&] { return drag_cost(scene, *n_moves); });
    json["drag"] = {{"update_ms", drag.update_ms}, {"excess", drag.excess}};
  }
  if (against) json["against"] = distance_json(scene, other_scene(*against, scene));
  if (wants_vertices) json["vertices"] = vertices_json(scene);
  std::printf("%s\n", json.dump().c_str());
  return cost.report.ok() ? Outcome::ok : Outcome::check_failed;
}

}  // namespace

extern const Command kBenchDeform(
    "deform", "SCENE.json | MESH.obj", "what the shape of least energy costs", bench_deform,
    {kDeformHelp},
    R"(  --drag N               then of a hand that takes the handles there in N moves
  --against OTHER.json   the distance to that shape, with the same fabric and form
  --vertices             how much each vertex has of the bending
)");

}  // namespace pleat
