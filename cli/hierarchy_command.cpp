#include <algorithm>
#include <array>
#include <cstdio>

#include "cli/command_table.h"
#include "cli/mesh_input.h"
#include "cli/overwriting.h"
#include "cli/scene_input.h"
#include "core/base/check.h"
#include "core/base/core_version.h"
#include "core/files/frame_file.h"
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
  const std::array<bool*, kCollapseGuardNames.size()> each{&guards.flips, &guards.borders,
                                                           &guards.links};
  for (const std::string& name : arguments.list("--without")) {
    const auto at = std::find(kCollapseGuardNames.begin(), kCollapseGuardNames.end(), name);
    if (at == kCollapseGuardNames.end())
      throw InputError("--without", "expected flips, borders or links, got " + cut(name));
    *each[static_cast<std::size_t>(at - kCollapseGuardNames.begin())] = false;
  }
  return guards;
}

HierarchyOptions take_hierarchy_options(Arguments& arguments) {
  HierarchyOptions options;
  options.n_coarser =
      arguments.whole_number("--levels", 1, kMostLevels).value_or(options.n_coarser);
  if (const auto ratio = arguments.text("--ratio")) {
    options.ratio = parse_positive_number(*ratio, "--ratio");
    try {
      options.validate();
    } catch (const InputError& error) {
      throw InputError("--ratio", error.what());
    }
  }
  if (const auto weights = arguments.text("--weights")) {
    const auto at = std::find(kTransferWeightsNames.begin(), kTransferWeightsNames.end(), *weights);
    if (at == kTransferWeightsNames.end())
      throw InputError("--weights",
                       "expected inverse_distance or moving_least_squares, got " + cut(*weights));
    options.weights = static_cast<TransferWeights>(at - kTransferWeightsNames.begin());
  }
  options.guards = take_guards(arguments);
  return options;
}

HierarchyInput take_mesh(Arguments& arguments) {
  const std::string file = arguments.word("an OBJ file or a scene");
  arguments.finish();
  HierarchyInput input;
  const ObjMesh obj = read_mesh(file);
  input.name = file;
  input.mesh.rest_positions = obj.positions;
  input.mesh.triangles = obj.triangles;
  input.files_read = {file};
  return input;
}

/// A scene's cloth at rest; its pinned vertices are on every level.
HierarchyInput take_cloth(Arguments& arguments) {
  const SceneInput scene = take_scene(arguments);
  arguments.finish();
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

/// What a table tells of a level.
struct LevelRow {
  int n_vertices, n_triangles, n_edges;
  double mean_edge;     ///< along the surface [m]
  double longest_edge;  ///< [m]
  double chord_gap;     ///< the most that a chord is shorter than the surface, over the latter
  double linear_error;  ///< of places from the next coarser level [m]; 0 on the coarsest
  LevelFaults faults;
};

std::vector<LevelRow> rows_of(const MeshHierarchy& hierarchy, const TriangleMesh& mesh) {
  const Positions& finest = mesh.rest_positions;
  std::vector<LevelRow> rows;
  for (std::size_t k = 0; k < hierarchy.levels.size(); ++k) {
    const MeshLevel& level = hierarchy.levels[k];
    LevelRow row{level.n_vertices(),
                 static_cast<int>(level.triangles.size()),
                 static_cast<int>(level.edges.size()),
                 0,
                 0,
                 0,
                 0,
                 level_faults(level, mesh)};
    for (const LevelEdge& edge : level.edges) {
      row.mean_edge += edge.geodesic / row.n_edges;
      row.longest_edge = std::max(row.longest_edge, edge.geodesic);
      constexpr double kRounding = 1e-9;
      const double gap = 1 - edge.chord / edge.geodesic;
      if (gap > kRounding) row.chord_gap = std::max(row.chord_gap, gap);
    }
    if (k + 1 < hierarchy.levels.size())
      row.linear_error =
          linear_error(level.from_coarser, positions_on(hierarchy.levels[k + 1], finest),
                       positions_on(level, finest));
    rows.push_back(row);
  }
  return rows;
}

Json json_hierarchy(const HierarchyInput& input, const std::vector<LevelRow>& rows,
                    const std::string& shortage, double seconds) {
  Json levels = Json::array();
  for (const LevelRow& row : rows)
    levels.push_back({{"n_vertices", row.n_vertices},
                      {"n_triangles", row.n_triangles},
                      {"n_edges", row.n_edges},
                      {"mean_edge_m", row.mean_edge},
                      {"longest_edge_m", row.longest_edge},
                      {"chord_gap", row.chord_gap},
                      {"linear_error_m", row.linear_error},
                      {"turned_triangles", row.faults.turned_triangles},
                      {"strayed_borders", row.faults.strayed_borders},
                      {"crowded_edges", row.faults.crowded_edges},
                      {"covered_share", row.faults.covered_share}});
  return {{"mesh", text_value(input.name)},
          {"levels", std::move(levels)},
          {"shortage", shortage},
          {"processor_ms", 1000 * seconds},
          {"core", core_version()}};
}

void print_hierarchy(const HierarchyInput& input, const std::vector<LevelRow>& rows,
                     const std::string& shortage, double seconds) {
  std::printf("%s\n", printable(input.name).c_str());
  std::printf(
      "level  vertices  triangles  mean edge mm  longest mm  chord shorter by %%  turned  strayed  "
      "crowded  covered %%  linear error mm\n");
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const LevelRow& row = rows[k];
    std::printf("%5zu  %8d  %9d  %12.4g  %10.4g  %18.3g  %6d  %7d  %7d  %9.4g", k, row.n_vertices,
                row.n_triangles, 1000 * row.mean_edge, 1000 * row.longest_edge, 100 * row.chord_gap,
                row.faults.turned_triangles, row.faults.strayed_borders, row.faults.crowded_edges,
                100 * row.faults.covered_share);
    if (k + 1 < rows.size()) std::printf("  %15.3g", 1000 * row.linear_error);
    std::printf("\n");
  }
  if (!shortage.empty()) std::printf("%s\n", shortage.c_str());
  std::printf("made in %.0f ms of processor time\n", 1000 * seconds);
}

void write_levels(const MeshHierarchy& hierarchy, const Positions& finest,
                  const std::string& folder) {
  FrameWriter writer(folder, FrameFormat::obj, {});
  double number = 0;
  for (const MeshLevel& level : hierarchy.levels) {
    writer.set_mesh({{}, level.triangles});
    writer.write(positions_on(level, finest), number++);
  }
  writer.finish();
}

Outcome hierarchy_command(Arguments arguments) {
  const bool for_machines = arguments.flag("--json");
  const auto folder = arguments.text("--out");
  Overwriting overwriting(arguments);
  overwriting.need(folder.has_value(), "--out");
  const HierarchyOptions options = take_hierarchy_options(arguments);
  const HierarchyInput input =
      arguments.has_word_ending(".json") ? take_cloth(arguments) : take_mesh(arguments);
  const auto old = prepare_frame_folder(folder, overwriting, input.files_read);
  const double begin = process_processor_time().value_or(0);
  const MeshHierarchy hierarchy = mesh_hierarchy(input.mesh, input.is_fixed, options);
  const double seconds = process_processor_time().value_or(0) - begin;
  const std::vector<LevelRow> rows = rows_of(hierarchy, input.mesh);
  if (for_machines)
    std::printf("%s\n", json_hierarchy(input, rows, hierarchy.shortage, seconds).dump().c_str());
  else
    print_hierarchy(input, rows, hierarchy.shortage, seconds);
  for (const std::filesystem::path& file : old) remove_file(file);
  if (folder) write_levels(hierarchy, input.mesh.rest_positions, *folder);
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
