#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/commands.h"
#include "cli/modal_input.h"
#include "cli/overwriting.h"
#include "cli/scene_input.h"
#include "core/base/check.h"
#include "core/base/core_version.h"
#include "core/files/frame_file.h"
#include "core/files/json_text.h"
#include "core/modal/cloth_modes.h"
#include "core/modal/surface_arap.h"
#include "core/run/simulation.h"
#include "core/run/timed_run.h"

namespace pleat {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kShownMove = 0.1;  // of a mode's farthest vertex in a file, over the extent
constexpr int kUsualModes = 20;

/// Modes of something that has a surface to show them on.
struct ModeTable {
  std::string subject;
  Modes modes;
  bool has_frequencies =
      false;          ///< [Hz]; else only ratios to the first that is not rigid mean something
  Positions surface;  ///< [m]
  std::vector<Triangle> triangles;
  SparseMatrix embedding;      ///< of the surface in what swings; empty: it is the surface
  std::vector<double> shares;  ///< of a motion, of the modes one after another; empty without one

  Positions shape(Eigen::Index mode) const {
    const Eigen::VectorXd column = modes.shapes.col(mode);
    const Eigen::Map<const Positions> moves(column.data(), 3, column.size() / 3);
    return embedding.size() > 0 ? Positions(moves * embedding) : Positions(moves);
  }
};

void check(const SolveReport& report) {
  if (report.ends_run()) throw InputError("", "no modes: " + report.message);
  if (!report.ok()) std::fprintf(stderr, "pleat: warning: %s\n", report.message.c_str());
}

Eigen::VectorXd three_each(const Eigen::VectorXd& of_vertex) {
  return of_vertex.replicate(1, 3).transpose().reshaped();
}

struct Material {
  double young = 1e6;     // [Pa]
  double density = 1000;  // [kg/m^3]
};

/// A mode of 1 Pa and 1 kg/m^3 has the same shape; its stiffness goes with Young's modulus over the
/// density.
ModeTable volume_table(const KeySurfaces& keys, const ModalOptions& options,
                       const Material& material) {
  ModeTable table;
  const CarryingVolume carrying =
      carrying_volume(keys.positions.front(), keys.mesh.triangles, options);
  check(volume_modes(carrying.volume, options.n_modes, table.modes));
  table.modes.stiffness *= material.young / material.density;
  table.modes.shapes /= std::sqrt(material.density);
  table.has_frequencies = options.volume.value_or(is_closed(keys.mesh.triangles)
                                                      ? VolumeKind::lattice
                                                      : VolumeKind::shell) == VolumeKind::lattice;
  table.embedding = carrying.embedding;
  table.surface = keys.positions.front();
  table.triangles = keys.mesh.triangles;
  table.subject = "volume of " + std::to_string(carrying.volume.n_vertices()) + " vertices and " +
                  std::to_string(carrying.volume.tets.size()) + " tetrahedra";
  return table;
}

ModeTable surface_table(const KeySurfaces& keys, int count) {
  ModeTable table;
  const Positions& x = keys.positions.front();
  const Eigen::VectorXd areas = surface_areas(x, keys.mesh.triangles);
  if (!(areas.minCoeff() > 0))
    throw InputError(keys.files.front().string(), "expected every vertex in a triangle with area");
  const std::vector<int> parts = surface_parts(x.cols(), keys.mesh.triangles);
  check(lowest_modes(surface_arap_hessian(x, keys.mesh.triangles, 1), three_each(areas),
                     rigid_motions(x, parts), count, table.modes));
  table.surface = x;
  table.triangles = keys.mesh.triangles;
  table.subject = "surface alone, " + std::to_string(x.cols()) + " vertices";
  return table;
}

/// About the state at the end of the scene's time; the motion until then is compared with it.
ModeTable cloth_table(const Scene& scene, int count) {
  Simulation simulation(scene);
  TimedRun run(simulation, TimedRun::Parts::untimed);
  std::vector<Positions> frames{simulation.state().positions};
  const std::int64_t n_steps = whole_steps(scene.duration, scene.method.step);
  while (simulation.n_steps() < n_steps && !run.has_ended()) {
    run.step();
    frames.push_back(simulation.state().positions);
  }
  if (run.has_ended()) throw InputError("", "the run ended: " + run.report().message);
  ModeTable table;
  const ClothModel& model = simulation.model();
  check(cloth_modes(model, frames.back(), {}, count, table.modes));
  const Eigen::VectorXd shares = motion_shares(table.modes, model.masses, frames.back(), frames);
  table.shares.assign(shares.begin(), shares.end());
  table.has_frequencies = true;
  table.surface = frames.back();
  table.triangles = simulation.triangles();
  table.subject = scene.name + " after " + Json(simulation.time()).dump() + " s, " +
                  std::to_string(model.n_vertices()) + " vertices";
  return table;
}

double frequency(double stiffness) {
  return std::copysign(std::sqrt(std::abs(stiffness)), stiffness) / (2 * kPi);
}

Json json_table(const ModeTable& table) {
  Json rows = Json::array();
  const Modes& modes = table.modes;
  const double first = modes.size() > modes.n_rigid ? modes.stiffness[modes.n_rigid] : 1;
  for (Eigen::Index m = 0; m < modes.size(); ++m) {
    Json row = {{"rigid", m < modes.n_rigid},
                {"residual", modes.residuals[m]},
                {"over_first", std::sqrt(std::max(modes.stiffness[m] / first, 0.0))}};
    if (table.has_frequencies) row["frequency_hz"] = frequency(modes.stiffness[m]);
    if (!table.shares.empty()) row["motion_share"] = table.shares[static_cast<std::size_t>(m)];
    rows.push_back(std::move(row));
  }
  return {{"subject", table.subject},
          {"n_rigid", modes.n_rigid},
          {"modes", std::move(rows)},
          {"core", core_version()}};
}

void print_table(const ModeTable& table) {
  const Modes& modes = table.modes;
  std::printf("%s: %d rigid motions, %d modes\n", printable(table.subject).c_str(), modes.n_rigid,
              static_cast<int>(modes.size()) - modes.n_rigid);
  std::printf("mode  %s  residual%s\n", table.has_frequencies ? "frequency [Hz]" : "over the first",
              table.shares.empty() ? "" : "  of the motion, with those before");
  const double first = modes.size() > modes.n_rigid ? modes.stiffness[modes.n_rigid] : 1;
  for (Eigen::Index m = modes.n_rigid; m < modes.size(); ++m) {
    std::printf("%4d  %-14.5g  %-8.1e", static_cast<int>(m) - modes.n_rigid + 1,
                table.has_frequencies ? frequency(modes.stiffness[m])
                                      : std::sqrt(modes.stiffness[m] / first),
                modes.residuals[m]);
    if (!table.shares.empty())
      std::printf("  %.3g %%", 100 * table.shares[static_cast<std::size_t>(m)]);
    std::printf("\n");
  }
  if (table.has_frequencies && modes.size() > 0 && modes.stiffness.minCoeff() < 0)
    std::printf(
        "a negative frequency is a way in which the shape falls rather than swings: it is "
        "not at rest\n");
}

/// One file for each mode that is no rigid motion.
void write_shapes(const ModeTable& table, const std::string& folder) {
  FrameWriter writer(folder, FrameFormat::obj, {{}, table.triangles});
  const double move = kShownMove * box_diagonal(table.surface);
  for (Eigen::Index m = table.modes.n_rigid; m < table.modes.size(); ++m) {
    const Positions shape = table.shape(m);
    writer.write(table.surface + move / shape.colwise().norm().maxCoeff() * shape,
                 static_cast<double>(m));
  }
  writer.finish();
}

/// Takes what only volumes have, and refuses it for what is none.
void refuse_volume_options(Arguments& arguments, const std::string& why) {
  for (const char* option : {"--volume", "--size", "--young", "--density"})
    arguments.refuse(option, why);
}

ModeTable table_of_scene(Arguments& arguments, const std::optional<std::string>& out,
                         Overwriting& overwriting) {
  refuse_volume_options(arguments, "a scene's modes are of its cloth, which has its own masses");
  arguments.refuse("--surface", "a scene's modes are of its cloth, which has its own forces");
  const int count = take_mode_count(arguments).value_or(kUsualModes);
  const SceneInput input = take_scene(arguments);
  arguments.finish();
  prepare_frame_folder(out, overwriting, input.files_read);
  return with_source_named(input, [&] { return cloth_table(input.scene, count); });
}

ModeTable table_of_mesh(Arguments& arguments, const std::optional<std::string>& out,
                        Overwriting& overwriting) {
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
  prepare_frame_folder(out, overwriting, mesh.files);
  return of_surface ? surface_table(mesh, options.n_modes) : volume_table(mesh, options, material);
}

}  // namespace

Outcome modes_command(Arguments arguments) {
  const bool for_machines = arguments.flag("--json");
  const auto out = arguments.text("--out");
  Overwriting overwriting(arguments);
  overwriting.need(out.has_value(), "--out");
  const ModeTable table = arguments.has_word_ending(".json")
                              ? table_of_scene(arguments, out, overwriting)
                              : table_of_mesh(arguments, out, overwriting);
  if (for_machines)
    std::printf("%s\n", json_table(table).dump().c_str());
  else
    print_table(table);
  if (out) write_shapes(table, *out);
  return Outcome::ok;
}

}  // namespace pleat
