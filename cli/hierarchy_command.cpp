#include <algorithm>
#include <cstdio>

#include "cli/command_table.h"
#include "cli/overwriting.h"
#include "cli/scene_input.h"
#include "core/base/core_version.h"
#include "core/hierarchy/level_faults.h"
#include "core/hierarchy/mesh_hierarchy.h"
#include "core/mesh/mesh_fault.h"
#include "core/scene/rest_cloth.h"
#include "core/sweep/platform.h"

namespace pleat {
namespace {

constexpr int kMostLevels = 30;

struct HierarchyInput {
  std::string name;
  TriangleMesh mesh;
  std::vector<bool> is_fixed;
  std::vector<std::filesystem::path> files_read;
};

CollapseGuards take_guards(Arguments& arguments) {
  CollapseGuards guards;
  for (const std::string& name : arguments.list("--without")) {
    if (name == "flips")
      guards.flips = false;
    else if (name == "borders")
      guards.borders = false;
    else if (name == "links")
      guards.links = false;
    else
      throw InputError("--without", "expected flips, borders or links, got " + quotation(name));
  }
  return guards;
}

HierarchyOptions take_hierarchy_options(Arguments& arguments) {
  HierarchyOptions options;
  options.n_coarser =
      arguments.whole_number("--levels", 1, kMostLevels).value_or(options.n_coarser);
  options.ratio = arguments.number("--ratio").value_or(options.ratio);
  with_source_named(Source{"", {{"ratio", "--ratio"}}}, [&] { options.validate(); });
  options.weights =
      arguments.choice("--weights", options.weights,
                       {{"inverse_distance", TransferWeights::inverse_distance},
                        {"moving_least_squares", TransferWeights::moving_least_squares}});
  options.guards = take_guards(arguments);
  return options;
}

HierarchyInput take_mesh(Arguments& arguments) {
  const std::string file = arguments.word("an OBJ file or a scene");
  arguments.finish();
  const ObjMesh obj = read_mesh(file);
  return {file, {obj.positions, obj.triangles, {}}, {}, {file}};
}

/// A scene's cloth at rest; its pinned vertices are on every level.
HierarchyInput take_cloth(Arguments& arguments) {
  const SceneInput scene = take_scene(arguments);
  return with_source_named(scene, [&] {
    const RestCloth cloth = rest_cloth(scene.scene);
    if (const auto fault = mesh_fault(cloth.mesh.rest_positions, cloth.mesh.triangles, 0))
      throw InputError("/cloth", fault->sentence);
    HierarchyInput input;
    input.name = scene.scene.name;
    input.mesh = cloth.mesh;
    input.is_fixed.resize(static_cast<std::size_t>(cloth.mesh.n_vertices()), false);
    for (const PinRule& rule : scene.scene.pins)
      for (const VertexId v : pinned_vertices(rule, cloth)) input.is_fixed[v] = true;
    input.files_read = scene.files_read;
    return input;
  });
}

Json json_levels(const MeshHierarchy& hierarchy, const TriangleMesh& mesh) {
  const Positions& finest = mesh.rest_positions;
  Json levels = Json::array();
  for (std::size_t k = 0; k < hierarchy.levels.size(); ++k) {
    const MeshLevel& level = hierarchy.levels[k];
    const auto n_edges = static_cast<double>(level.edges.size());
    double mean_edge = 0;     // measured along the surface [m]
    double longest_edge = 0;  // [m]
    double chord_gap = 0;     // the most that a chord is shorter than the surface, over the latter
    for (const LevelEdge& edge : level.edges) {
      mean_edge += edge.geodesic / n_edges;
      longest_edge = std::max(longest_edge, edge.geodesic);
      constexpr double kRounding = 1e-9;
      const double gap = 1 - edge.chord / edge.geodesic;
      if (gap > kRounding) chord_gap = std::max(chord_gap, gap);
    }
    double error = 0;  // places from the next coarser level miss so much [m]
    if (k + 1 < hierarchy.levels.size())
      error = linear_error(level.from_coarser, positions_on(hierarchy.levels[k + 1], finest),
                           positions_on(level, finest));
    const LevelFaults faults = level_faults(level, mesh);
    levels.push_back({{"n_vertices", level.n_vertices()},
                      {"n_triangles", level.triangles.size()},
                      {"n_edges", level.edges.size()},
                      {"mean_edge_m", mean_edge},
                      {"longest_edge_m", longest_edge},
                      {"chord_gap", chord_gap},
                      {"linear_error_m", error},
                      {"turned_triangles", faults.turned_triangles},
                      {"strayed_borders", faults.strayed_borders},
                      {"crowded_edges", faults.crowded_edges},
                      {"covered_share", faults.covered_share}});
  }
  return levels;
}

void print_hierarchy(const std::string& name, const Json& json) {
  std::printf("%s\n", printable(name).c_str());
  std::printf(
      "level  vertices  triangles  mean edge mm  longest mm  chord shorter by %%  turned  strayed  "
      "crowded  covered %%  linear error mm\n");
  const Json& levels = json["levels"];
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const auto number = [&](const char* key) { return levels[k][key].get<double>(); };
    std::printf("%5zu  %8.0f  %9.0f  %12.4g  %10.4g  %18.3g  %6.0f  %7.0f  %7.0f  %9.4g", k,
                number("n_vertices"), number("n_triangles"), 1000 * number("mean_edge_m"),
                1000 * number("longest_edge_m"), 100 * number("chord_gap"),
                number("turned_triangles"), number("strayed_borders"), number("crowded_edges"),
                100 * number("covered_share"));
    if (k + 1 < levels.size()) std::printf("  %15.3g", 1000 * number("linear_error_m"));
    std::printf("\n");
  }
  const auto shortage = json["shortage"].get<std::string>();
  if (!shortage.empty()) std::printf("%s\n", shortage.c_str());
  std::printf("made in %.0f ms of processor time\n", json["processor_ms"].get<double>());
}

Outcome hierarchy_command(Arguments arguments) {
  const bool for_machines = arguments.flag("--json");
  FrameFolder out(arguments);
  const HierarchyOptions options = take_hierarchy_options(arguments);
  const HierarchyInput input =
      arguments.has_word_ending(".json") ? take_cloth(arguments) : take_mesh(arguments);
  out.prepare(input.files_read);
  const double begin = process_processor_time().value_or(0);
  const MeshHierarchy hierarchy = mesh_hierarchy(input.mesh, input.is_fixed, options);
  const double seconds = process_processor_time().value_or(0) - begin;
  const Json json = {{"mesh", text_value(input.name)},
                     {"levels", json_levels(hierarchy, input.mesh)},
                     {"shortage", hierarchy.shortage},
                     {"processor_ms", 1000 * seconds},
                     {"core", core_version()}};
  if (for_machines)
    std::printf("%s\n", json.dump().c_str());
  else
    print_hierarchy(input.name, json);
  if (!out) return Outcome::ok;
  FrameWriter writer = out.open(FrameFormat::obj, {});
  double number = 0;
  for (const MeshLevel& level : hierarchy.levels) {
    writer.set_mesh({{}, level.triangles});
    writer.write(positions_on(level, input.mesh.rest_positions), number++);
  }
  writer.finish();
  return Outcome::ok;
}

}  // namespace

extern const Command kHierarchyCommand(
    "hierarchy", "MESH.obj | SCENE.json", "ever coarser meshes of vertices of a mesh, by quadrics",
    hierarchy_command,
    {kOverwriteHelp, kJsonHelp, "  Of a scene's cloth:\n", kFabricHelp, kMethodHelp},
    R"(  --levels N             beside the finest (default 3);  --ratio R  of vertices kept (default 0.5)
  --weights NAME         of corrections: inverse_distance (default) or moving_least_squares
  --without A,B          of the guards flips, borders and links, to see what goes wrong
  --out DIR              write each level as an OBJ file
)");

}  // namespace pleat
