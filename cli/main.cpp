#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "core/base/check.h"
#include "core/base/core_version.h"
#include "core/dynamics/stepper_table.h"
#include "core/files/json_text.h"
#include "core/files/whole_file.h"

namespace pleat {
namespace {

constexpr int kExitCheckFailed = 1;
constexpr int kExitBadInput = 2;
constexpr int kExitOwnFault = 3;

constexpr const char* kHelp =
    R"(pleat run SCENE.json     compute a scene
  --out DIR              write frames and metrics.json into this folder, which holds none yet
  --dump DIR             write mass.mtx, stiffness_begin.mtx and stiffness_end.mtx (Matrix Market)
                         into this folder, which holds none yet
  --state FILE           write where the cloth is and how fast at the end, for a scene's "start"
  --check                exit status 1 when there is a warning: the run shows nonsense, or a step
                         did not converge
  --overwrite            remove or replace those of an earlier run
  --drift                account for the energy: what no force explains is the method's own
  --steps N | --duration S    the latter rounded to whole steps
pleat sweep SCENE.json   compute it with many settings: milliseconds against error
pleat sweep PLAN.json    the same with the settings that a plan lists
  --set POINTER=V1,V2    values in the scene, such as /method/substeps=1,4; with several of these
                         every value of one with every value of the others
  --levels 0,1,2         the same for /refinement/level (default: the scene's)
  --steppers A,B         usual settings of these (default: those that suit the model; with --set the
                         scene's own method)
  --reference KIND       converged (default): newton with its step checked and, where levels are
                         compared, on the next finer mesh, checked too; same_mesh: what steps alone
                         do wrong; closed_form: a shape at rest; rigid_chain: a sheet swinging from
                         its edge
  --reference-level N    of the mesh of converged, at least the finest compared
  --repeat N             timed runs of each setting (default 5)
  --steps N | --duration S    compare over this time
  --out DIR              write rows.jsonl, table.md and front.svg into this folder; started again, a
                         sweep that was stopped goes on
  --overwrite            remove those of another sweep from it first
  --cache DIR            keep references here (default: in the folder after --out)
  --ship-references DIR  no rows: make what they are compared with and keep it here, with 32-bit
                         positions; --keep-level N  of finer meshes the vertices of this one alone
  --commit TEXT          what the rows say was measured (default: a hash of the core's sources)
                         A row marked ! shows nonsense and is on no front. A residual is that of a
                         stepper's own equations; of direct solvers it is not measured, "-" or null.
pleat reference SCENE.json    make one by newton and tell how well it is known
  --kind same_mesh       (default) halve its step; converged: halve its step and its mesh
  --keep-level N         keep the vertices of this coarser mesh alone
  --step S               of it (default 1/960 s);  --every S  of its samples (default 1/60 s)
  --steps N | --duration S
  --out FILE             keep it, with 32-bit positions
pleat refine EXAMPLE.json    run it on a fine mesh and plan where its cloth needs one
  --level N              of the fine mesh (default 2);  --cap N  finest level of the plan
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
pleat deform SCENE.json  the shape of least energy of a cloth that is pinned and pulled
pleat deform MESH.obj    the same of any mesh
  --pin PLACE            hold what is there; --handle PLACE:X,Y,Z  move it so far [m]. Each may come
                         several times, beside the scene's own. A place is vertex numbers from 0
                         (3 or 3,4), a group's name, box:X,Y,Z,X,Y,Z (two corners) or near:X,Y,Z
                         (a twentieth of the cloth's longest side around it) or near:X,Y,Z,R;
                         a handle's place may be the name of the scene's, which then goes there
  --fabric NAME          of the library; --measure R,S,B  own measurements of recovery, stretch and
                         bending; --weights R,S,B  the three terms' weights themselves
  --form published       sums over vertices and edges; consistent (default): integrals over cloth
  --terms A,B            leave out those of recovery, stretch and bending that are not named
  --out FILE.obj         write the shape with the mesh's texture coordinates and groups
  --check                exit status 1 when there is a warning: it stopped short of the least energy
pleat modes MESH.obj     the softest ways in which a body swings
  --modes N              how many beside the rigid motions (default 20)
  --volume lattice|shell that carries the surface (default: a lattice in a closed one, else a shell)
  --size S               edge of the lattice or thickness of the shell [m]
  --young E --density D  of the lattice (default 1e6 Pa and 1000 kg/m3); shells have no frequencies
  --surface              of the surface's own energy instead
pleat modes SCENE.json   of its cloth about the shape it has come to at its end, and how much of the
                         motion until then they span
  --out DIR              write the modes as OBJ files, the farthest vertex moved by a tenth
pleat inbetween A.obj B.obj ...   frames between key shapes with the same vertices and faces
  --frames N             with the keys (default 60);  --step D  until no vertex moves farther [m]
  --volume, --size, --modes N  as of modes (default 40 of each key)
  --functions N --clusters N   of the space of shapes (default 64 and 64)
  --exact-keys           the keys themselves are in the space
  --detail-beyond D      patches that the space meets to D [m] have no detail of their own
  --out DIR              write the frames as OBJ files;  --check  as of run
pleat hierarchy MESH.obj | SCENE.json   ever coarser meshes of vertices of a mesh, by quadrics
  --levels N             beside the finest (default 3);  --ratio R  of vertices kept (default 0.5)
  --weights NAME         of corrections: inverse_distance (default) or moving_least_squares
  --without A,B          of the guards flips, borders and links, to see what goes wrong
  --out DIR              write each level as an OBJ file
pleat convergence SCENE.json   one step solved from the same predicted places: error after 1, 2, 3,
                         5, 9, ... rounds of each method, and where it is first below 0.1 to 0.0001
  --at S                 when the step begins (default 0); until then the scene's method runs
  --methods A,B,M.json   steppers, or files with a "method" (default: pbd,hpbd,multigrid,xpbd)
  --constraints rigid|compliant    of position-based methods (default: rigid)
  --diagonals one|both   of quads, as springs (default: one, as rigid ones contradict each other)
  --rounds N             at most (default 1025);  --repeat N  timed batches of each (default 1)
pleat hard-cases [NAME ...]   what breaks cloth systems, run with every stepper: ok, or why not
  --stepper NAME         with this one alone
  --short                the lengths that are tests
  --scenes DIR           of the cases' scenes (default: assets/hard_cases)
  --markdown FILE  --json FILE   write the tables, or each outcome on a line
                         Exit status 1 when something is unexpected.
pleat bench run SCENE.json        what one run costs, with positions to compare
  --frames N             of 1/60 s (default 60);  --times T1,T2  of the positions, within them
  --parts                what the parts of a step cost
  --bare                 the stepper alone on masses, springs, pins and weight: what else a scene
                         could ask for costs, where it does not, what a run takes more than this
  --turns                print "ready" after the first frame and wait for a line with the number of
                         frames of the next turn, until all have been run
pleat bench reference SCENE.json  positions that are taken for right
  --times T1,T2 (default: the scene's end, or that of --steps N | --duration S)
  --kind run (default), or rigid_chain or closed_form, which take no option of a method
  --cache DIR            keep runs here;  --halved  how far twice the step is from it
pleat bench deform SCENE.json     what the shape of least energy costs
  --drag N               then of a hand that takes the handles there in N moves
  --against OTHER.json   the distance to that shape, with the same fabric and form
  --vertices             how much each vertex has of the bending
pleat bench inbetween A.obj B.obj ...   what frames between keys cost, with the options of inbetween
  --against DIR          the distance to the nearest of a run's frames;  --unreduced  also of frames
                         for which no space was made
pleat bench plans SCENE.json      plans that one example run leads to, and what they cost
  --demand X,Y --vertices N,M  a plan each;  --criterion C  --patterns N  --cap N  --from S  as of
                         refine
pleat bench together SCENE.json   runs of one cloth, frame of 1/30 s by frame in turn
  --with A.json,B.json   the others, whose errors are against the first
  --adaptive K           one more, split anew in every frame where the first's base cloth bends more
                         than K [1/m]
  --from S               of what is timed and compared (default: half);  --every N  frames compared
pleat bench restarts SCENE.json   what meshes make wrong before chance does: they start anew from the
                         scene's state, sampled, and are held against it a while later
  --with A.json,B.json   the meshes;  --every S  from one restart to the next (default 1)
  --after S              how long each runs (default 0.25)
pleat bench response SCENE.json   how touched vertices move along the normal after first contact, with
                         cloth that rests on solids and with cloth that bounces
  --window S             after first contact (default: 0.05)
pleat bench rows RUNS.json        rows with speed and error, of runs as bench run prints them
pleat bench limit RUNS.json       where runs on three meshes lead, each with edges half as long
pleat help | --version

Changes to the scene, for every command but deform, which takes --fabrics and --json too:
  --fabric NAME  --step S  --solver NAME  --tolerance X
  --fabrics FILE         read the fabrics from here
and for every command but sweep, which has --levels and --steppers:
  --level N  --stepper NAME  --substeps N  --iterations N
--json prints for machines. --overwrite lets --out write where a file stands, for every command that
writes one; what a command reads is never written over. --step=S is --step S.
With another --stepper than the scene's, settings that it does not read or does not take are left
out. --fabric leaves out all of the scene's own numbers. Exit status: 0 done, 1 ran but a check
failed or the output was lost, 2 bad input, 3 a fault of the program.
)";

Outcome dispatch(const std::string& command, Arguments arguments) {
  if (command == "run") return run_command(std::move(arguments));
  if (command == "sweep") return sweep_command(std::move(arguments));
  if (command == "reference") return reference_command(std::move(arguments));
  if (command == "refine") return refine_command(std::move(arguments));
  if (command == "bench") return bench_command(std::move(arguments));
  if (command == "deform") return deform_command(std::move(arguments));
  if (command == "modes") return modes_command(std::move(arguments));
  if (command == "inbetween") return inbetween_command(std::move(arguments));
  if (command == "hierarchy") return hierarchy_command(std::move(arguments));
  if (command == "convergence") return convergence_command(std::move(arguments));
  if (command == "hard-cases") return hard_cases_command(std::move(arguments));
  if (command == "help" || command == "--help" || command == "-h") {
    arguments.finish();
    std::fputs(kHelp, stdout);
    std::printf("\nSteppers:\n%s", stepper_help(standard_steppers()).c_str());
    return Outcome::ok;
  }
  if (command == "--version") {
    arguments.finish();
    std::printf("pleat %s\n", core_version());
    return Outcome::ok;
  }
  throw InputError(cut(command),
                   "unknown command; the commands are run, sweep, reference, refine, deform, "
                   "modes, inbetween, hierarchy, convergence, hard-cases, bench and help");
}

int run(const std::vector<std::string>& words) {
  const std::string command = words.empty() ? "help" : words.front();
  std::vector<std::string> rest(words.empty() ? words.end() : words.begin() + 1, words.end());
  for (const std::string& word : rest)
    if (word == "--help" || word == "-h") return run({"help"});
  const Outcome outcome = dispatch(command, Arguments(std::move(rest)));
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    std::fputs("pleat: the output could not be written whole\n", stderr);
    return kExitCheckFailed;
  }
  return outcome == Outcome::ok ? 0 : kExitCheckFailed;
}

}  // namespace
}  // namespace pleat

int main(int argc, char** argv) {
#ifdef SIGXFSZ
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of file sizes is then an output that is lost
#endif
  try {
    return pleat::run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (const pleat::LostOutput& error) {
    std::fprintf(stderr, "pleat: %s\n", pleat::printable(error.what()).c_str());
    return pleat::kExitCheckFailed;
  } catch (const pleat::InputError& error) {
    const std::string place = error.where().empty() ? "" : error.where() + ": ";
    std::fprintf(stderr, "pleat: %s\n", pleat::printable(place + error.what()).c_str());
    return pleat::kExitBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pleat: this is a fault of the program: %s\n", error.what());
    return pleat::kExitOwnFault;
  }
}
