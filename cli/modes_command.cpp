#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/command_table.h"
#include "cli/modal_input.h"
#include "cli/overwriting.h"
#include "cli/scene_input.h"
#include "core/base/check.h"
#include "core/base/core_version.h"
#include "core/files/frame_file.h"
#include "core/files/json_text.h"
#include "core/modal/cloth_modes.h"
#include "core/modal/shown_modes.h"
#include "core/run/simulation.h"
#include "core/run/timed_run.h"
#include "core/scene/tearing.h"

namespace pleat {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kShownMove = 0.1;  // of a mode's farthest vertex in a file, over the extent
constexpr int kUsualModes = 20;

/// Modes of something that has a surface to show them on.
struct ModeTable {
  std::string subject;
  SurfaceModes modes;
  double hertz_of_one = 0;  ///< frequency where the stiffness is 1 [Hz]; 0: it means nothing
  Positions surface;        ///< [m]
  std::vector<Triangle> triangles;
  std::vector<double> shares;  ///< of a motion, of the modes one after another; empty without one

  bool has_frequencies() const { return hertz_of_one > 0; }
  /// Below zero for a way that the shape falls.
  double frequency(Eigen::Index mode) const {
    const double stiffness = modes.stiffness[mode];
    return std::copysign(std::sqrt(std::abs(stiffness)), stiffness) * hertz_of_one;
  }
  double over_first(Eigen::Index mode) const {
    return std::sqrt(std::max(modes.stiffness[mode] / modes.stiffness[0], 0.0));
  }
};

struct Material {
  double young = 1e6;     // [Pa]
  double density = 1000;  // [kg/m^3]
};

/// A mode of 1 Pa and 1 kg/m^3 has the same shape; its stiffness goes with Young's modulus over the
/// density.
ModeTable volume_table(const KeySurfaces& mesh, const ModalOptions& options,
                       const Material& material) {
  const Positions& surface = mesh.positions.front();
  const std::vector<Triangle>& triangles = mesh.mesh.triangles;
  ModeTable table;
  table.modes = volume_surface_modes(surface, triangles, options);
  if (volume_kind(triangles, options) == VolumeKind::lattice)
    table.hertz_of_one = std::sqrt(material.young / material.density) / (2 * kPi);
  table.surface = surface;
  table.triangles = triangles;
  table.subject = "volume of " + std::to_string(table.modes.n_tets) + " tetrahedra";
  return table;
}

ModeTable surface_table(const KeySurfaces& mesh, int count) {
  const Positions& surface = mesh.positions.front();
  ModeTable table;
  table.modes = surface_modes(surface, mesh.mesh.triangles, count);
  table.surface = surface;
  table.triangles = mesh.mesh.triangles;
  table.subject = "surface alone, " + std::to_string(surface.cols()) + " vertices";
  return table;
}

/// About the state at the end of the scene's time; the motion until then is compared with it.
ModeTable cloth_table(const Scene& scene, int count) {
  expect_whole(scene);
  Simulation simulation(scene);
  TimedRun run(simulation, TimedRun::Parts::untimed);
  std::vector<Positions> frames{simulation.state().positions};
  const std::int64_t n_steps = whole_steps(scene.duration, scene.method.step);
  while (simulation.n_steps() < n_steps && !run.has_ended()) {
    run.step();
    frames.push_back(simulation.state().positions);
  }
  if (run.has_ended()) throw InputError("", "the run ended: " + run.report().message);
  const ClothModel& model = simulation.model();
  Modes modes;
  const SolveReport report = cloth_modes(model, frames.back(), {}, count, modes);
  if (report.ends_run()) throw InputError("", "the modes were not found: " + report.message);
  const Eigen::VectorXd shares = motion_shares(modes, model.masses, frames.back(), frames);
  const SurfaceModes whole = whole_surface_modes(modes);
  ModeTable table;
  table.modes = whole;
  table.shares.assign(shares.begin() + whole.n_costless, shares.end());
  table.hertz_of_one = 1 / (2 * kPi);
  table.surface = frames.back();
  table.triangles = simulation.triangles();
  table.subject = scene.name + " after " + Json(simulation.time()).dump() + " s, " +
                  std::to_string(model.n_vertices()) + " vertices";
  return table;
}

Json json_table(const ModeTable& table) {
  Json rows = Json::array();
  for (Eigen::Index m = 0; m < table.modes.size(); ++m) {
    Json row = {{"over_first", table.over_first(m)}, {"residual", table.modes.residuals[m]}};
    if (table.has_frequencies()) row["frequency_hz"] = table.frequency(m);
    if (!table.shares.empty()) row["motion_share"] = table.shares[static_cast<std::size_t>(m)];
    rows.push_back(std::move(row));
  }
  return {{"subject", table.subject},
          {"n_rigid", table.modes.n_rigid},
          {"n_costless", table.modes.n_costless},
          {"modes", std::move(rows)},
          {"core", core_version()}};
}

void print_table(const ModeTable& table) {
  std::printf("%s: %d rigid motions, %d more that cost nothing, %d modes\n",
              printable(table.subject).c_str(), table.modes.n_rigid, table.modes.n_costless,
              static_cast<int>(table.modes.size()));
  std::printf("mode  %s  residual%s\n",
              table.has_frequencies() ? "frequency [Hz]" : "over the first",
              table.shares.empty() ? "" : "  of the motion, with those before");
  for (Eigen::Index m = 0; m < table.modes.size(); ++m) {
    std::printf("%4d  %-14.5g  %-8.1e", static_cast<int>(m) + 1,
                table.has_frequencies() ? table.frequency(m) : table.over_first(m),
                table.modes.residuals[m]);
    if (!table.shares.empty())
      std::printf("  %.3g %%", 100 * table.shares[static_cast<std::size_t>(m)]);
    std::printf("\n");
  }
  if (table.modes.size() > 0 && table.modes.stiffness.minCoeff() < 0)
    std::printf(
        "a negative frequency is a way in which the shape falls rather than swings: it is "
        "not at rest\n");
}

/// One file for each mode.
void write_shapes(const ModeTable& table, const std::string& folder) {
  FrameWriter writer(folder, FrameFormat::obj, {{}, table.triangles});
  const double move = kShownMove * box_diagonal(table.surface);
  for (Eigen::Index m = 0; m < table.modes.size(); ++m)
    writer.write(table.surface + move * table.modes.moves.col(m).reshaped(3, table.surface.cols()),
                 static_cast<double>(m));
  writer.finish();
}

/// The folder after --out, if there is one.
struct FrameFolder {
  std::optional<std::string> folder;
  Overwriting& overwriting;
  std::vector<std::filesystem::path> old;

  void prepare(const std::vector<std::filesystem::path>& files_read) {
    old = prepare_frame_folder(folder, overwriting, files_read);
  }
};

/// Takes what only volumes have, and refuses it for what is none.
void refuse_volume_options(Arguments& arguments, const std::string& why) {
  for (const char* option : {"--volume", "--size", "--young", "--density"})
    arguments.refuse(option, why);
}

ModeTable table_of_scene(Arguments& arguments, FrameFolder& out) {
  refuse_volume_options(arguments, "a scene's modes are of its cloth, which has its own masses");
  arguments.refuse("--surface", "a scene's modes are of its cloth, which has its own forces");
  const int count = take_mode_count(arguments).value_or(kUsualModes);
  const SceneInput input = take_scene(arguments);
  arguments.finish();
  out.prepare(input.files_read);
  return with_source_named(input, [&] { return cloth_table(input.scene, count); });
}

ModeTable table_of_mesh(Arguments& arguments, FrameFolder& out) {
  const bool of_surface = arguments.flag("--surface");
  if (of_surface) refuse_volume_options(arguments, "a surface alone has no volume");
  Material material;
  if (const auto young = arguments.text("--young"))
    material.young = parse_positive_number(*young, "--young");
  if (const auto density = arguments.text("--density"))
    material.density = parse_positive_number(*density, "--density");
  ModalOptions options = take_volume_options(arguments);
  options.n_modes = take_mode_count(arguments).value_or(kUsualModes);
  const KeySurfaces mesh = take_keys(arguments);
  if (mesh.files.size() > 1)
    throw InputError(mesh.files[1].string(), "one word too many; modes are of one mesh");
  out.prepare(mesh.files);
  return of_surface ? surface_table(mesh, options.n_modes) : volume_table(mesh, options, material);
}

Outcome modes_command(Arguments arguments) {
  const bool for_machines = arguments.flag("--json");
  const auto folder = arguments.text("--out");
  Overwriting overwriting(arguments);
  overwriting.need(folder.has_value(), "--out");
  FrameFolder out{folder, overwriting, {}};
  const ModeTable table = arguments.has_word_ending(".json") ? table_of_scene(arguments, out)
                                                             : table_of_mesh(arguments, out);
  if (for_machines)
    std::printf("%s\n", json_table(table).dump().c_str());
  else
    print_table(table);
  for (const std::filesystem::path& file : out.old) remove_file(file);
  if (folder) write_shapes(table, *folder);
  return Outcome::ok;
}

}  // namespace

extern const Command kModesCommand(
    "modes", "MESH.obj | SCENE.json", "the softest ways in which a body or a cloth swings",
    modes_command, {kFabricHelp, kMethodHelp, kTimeHelp, kOverwriteHelp, kJsonHelp},
    R"(  --modes N              how many beside the rigid motions (default 20)
  --out DIR              write the modes as OBJ files, the farthest vertex moved by a tenth
  Of a mesh:
  --volume lattice|shell that carries the surface (default: a lattice in a closed one, else a shell)
  --size S               edge of the lattice or thickness of the shell [m]
  --young E --density D  of the lattice (default 1e6 Pa and 1000 kg/m3); shells have no frequencies
  --surface              of the surface's own energy instead
  Of a scene's cloth, about the shape it has come to at its end, with how much of the motion until
  then they span:
)");

}  // namespace pleat
