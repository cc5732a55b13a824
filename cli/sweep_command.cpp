#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/command_table.h"
#include "cli/overwriting.h"
#include "cli/progress.h"
#include "cli/reference_folder.h"
#include "cli/run_warnings.h"
#include "cli/shipped_references.h"
#include "cli/sweep_folder.h"
#include "cli/sweep_input.h"
#include "core/base/check.h"
#include "core/base/core_version.h"
#include "core/sweep/sweep.h"

namespace pleat {
namespace {

/// Runs what no earlier start has run. `folder` may be null.
void work_through(Sweep& sweep, const SweepInput& input, SweepFolder* folder) {
  if (folder != nullptr) {
    folder->open_journal(sweep.resume(folder->journal()));
    sweep.on_run([folder](const std::string& line) { folder->record(line); });
  }
  Progress progress;
  int n_rounds = sweep.n_rounds_done();
  while (!sweep.done()) {
    with_source_named(input, [&] { sweep.advance(kProgressSlice); });
    progress.show(sweep.progress(), sweep.message());
    if (folder == nullptr || sweep.n_rounds_done() == n_rounds) continue;
    n_rounds = sweep.n_rounds_done();
    folder->write_results(sweep);
  }
  if (folder != nullptr) folder->write_results(sweep);
}

bool has_error(const BenchRow& row) { return std::isfinite(row.position_error); }

/// Says on stderr when no error is known. One of several that is below what the reference can tell
/// is told in its row.
Outcome judged(const std::vector<BenchRow>& rows) {
  const auto finished = [](const BenchRow& row) { return row.finished(); };
  const auto lacks_reference = [](const BenchRow& row) {
    return row.finished() && !has_error(row) && !std::isfinite(row.reference.uncertainty);
  };
  const auto unmeasured = std::find_if(rows.begin(), rows.end(), lacks_reference);
  const bool none_known = std::none_of(rows.begin(), rows.end(), has_error);
  if (unmeasured != rows.end())
    std::fprintf(stderr, "pleat: no errors, as the reference is %s\n",
                 unmeasured->reference.description.c_str());
  else if (none_known && std::any_of(rows.begin(), rows.end(), finished))
    std::fputs("pleat: no errors, as the reference is not known well enough to tell any\n", stderr);
  const bool all_finished = std::all_of(rows.begin(), rows.end(), finished);
  const bool all_well = all_finished && unmeasured == rows.end() && !none_known;
  return all_well ? Outcome::ok : Outcome::check_failed;
}

/// Says what the first row with warnings shows, and how many more have some.
void tell_first_warned(const std::vector<BenchRow>& rows) {
  const auto is_warned = [](const BenchRow& row) { return !row.warnings.empty(); };
  const auto first = std::find_if(rows.begin(), rows.end(), is_warned);
  if (first == rows.end()) return;
  tell_warnings(first->warnings, setting_phrase(*first));
  const auto n_more = std::count_if(first + 1, rows.end(), is_warned);
  if (n_more > 0)
    std::fprintf(stderr, "pleat: warning: %lld more rows have warnings\n",
                 static_cast<long long>(n_more));
}

Outcome sweep_command(Arguments arguments) {
  const bool for_machines = arguments.flag("--json");
  Overwriting overwriting(arguments);
  const auto out = arguments.text("--out");
  const auto cache = arguments.text("--cache");
  const auto ship = arguments.text("--ship-references");
  const auto kept_level = arguments.whole_number("--keep-level", 0, kMaxLevel);
  if (ship && (out || for_machines))
    throw InputError("--ship-references", "makes no rows for --out and --json");
  if (kept_level && !ship) throw InputError("--keep-level", "expected --ship-references beside it");
  const std::string commit =
      text_value(arguments.text("--commit").value_or(core_version())).get<std::string>();
  const SweepInput input = take_sweep(arguments);
  arguments.finish();
  overwriting.need(out || ship, "--out or --ship-references");
  overwriting.spare(input.files_read());

  const std::string identity =
      with_source_named(input, [&] { return sweep_identity(input.plan, commit); });
  std::optional<SweepFolder> folder;
  if (out) folder.emplace(*out, identity, overwriting);
  std::unique_ptr<ReferenceStore> store = std::make_unique<MemoryReferenceStore>();
  if (cache || out)
    store = std::make_unique<ReferenceFolder>(cache ? std::filesystem::path(*cache)
                                                    : folder->references());
  if (ship) {
    const bool all_made = with_source_named(
        input, [&] { return ship_references(input.plan, *store, *ship, kept_level, overwriting); });
    return all_made ? Outcome::ok : Outcome::check_failed;
  }
  Sweep sweep(input.plan, *store, commit);
  work_through(sweep, input, folder ? &*folder : nullptr);
  std::fputs((for_machines ? json_lines(sweep.rows()) : sweep_table(sweep)).c_str(), stdout);
  tell_first_warned(sweep.rows());
  return judged(sweep.rows());
}

}  // namespace

extern const Command kSweepCommand("sweep", "SCENE.json | PLAN.json",
                                   "compute a scene with many settings: milliseconds against error",
                                   sweep_command,
                                   {kFabricHelp, kTimeHelp, R"(  Of both:
  --out DIR              write rows.jsonl, table.md and front.svg into this folder; started again, a
                         sweep that was stopped goes on
  --overwrite            remove those of another sweep from it first
  --cache DIR            keep references here (default: in the folder after --out)
  --ship-references DIR  no rows: make what they are compared with and keep it here, with 32-bit
                         positions; --keep-level N  of finer meshes the vertices of this one alone
  --commit TEXT          what the rows say was measured (default: a hash of the core's sources)
  A row marked ! shows nonsense and is on no front. A residual is that of a stepper's own equations;
  of direct solvers it is not measured, "-" or null.
)",
                                    kJsonHelp},
                                   R"(  A plan lists its settings itself. Of a scene:
  --set POINTER=V1,V2    values in the scene, such as /method/substeps=1,4; with several of these
                         every value of one with every value of the others
  --levels 0,1,2         values of /refinement/level (default: the scene's)
  --steppers A,B         usual settings of these (default: those that suit the model; with --set the
                         scene's own method)
  --reference KIND       converged (default): newton with its step checked and, where levels are
                         compared, on the next finer mesh, checked too; same_mesh: what steps alone
                         do wrong; closed_form: a shape at rest; rigid_chain: a sheet swinging from
                         its edge
  --reference-level N    of the mesh of converged, at least the finest compared
  --repeat N             timed runs of each setting (default 5)
  --step S  --solver NAME  --tolerance X    in place of the scene's
)");

}  // namespace pleat
