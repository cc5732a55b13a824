#include "core/error/restarts.h"

#include <limits>
#include <memory>

#include "core/base/check.h"
#include "core/error/error_norms.h"
#include "core/error/mesh_sampling.h"
#include "core/run/simulation.h"
#include "core/scene/format/scene_file.h"
#include "core/scene/tearing.h"

namespace pleat {
namespace {

/// A mesh that starts anew from time to time.
struct Restarted {
  Restarted(const Scene& scene, const QuadMesh& fine)
      : simulation(scene),
        sampling(quads_of(simulation), fine),
        areas(simulation.mesh()->vertex_areas()) {}

  static const QuadMesh& quads_of(const Simulation& simulation) {
    if (simulation.mesh() == nullptr)
      throw InputError("/cloth", "expected a sheet or a garment, got cloth that is not of quads");
    return *simulation.mesh();
  }

  void start(const Simulation& fine) {
    const State& state = fine.state();
    const Positions held = fine.contact_accelerations();
    simulation.go_on_from({sampling.sampled(state.positions), sampling.sampled(state.velocities)},
                          fine.time(), held.cols() > 0 ? sampling.sampled(held) : held);
  }

  Simulation simulation;
  MeshSampling sampling;
  Eigen::VectorXd areas;
};

bool run(Simulation& simulation, std::int64_t n_steps) {
  for (std::int64_t k = 0; k < n_steps; ++k)
    if (simulation.step().ends_run()) return false;
  return true;
}

}  // namespace

void RestartOptions::validate() const {
  if (!(after > 0 && after < begin))
    throw InputError("time after a restart", "expected a number > 0 and below that between two, " +
                                                 std::to_string(begin) + " s, got " +
                                                 std::to_string(after));
  if (!(duration >= begin + after))
    throw InputError("duration", "expected time for a restart, " + std::to_string(begin + after) +
                                     " s, got " + std::to_string(duration));
}

std::vector<std::vector<double>> restart_errors(const Scene& fine, const std::vector<Scene>& others,
                                                const RestartOptions& options) {
  options.validate();
  expect_whole(fine);
  const double step = fine.method.step;
  Simulation reference(fine);
  const QuadMesh& fine_mesh = Restarted::quads_of(reference);
  std::vector<std::unique_ptr<Restarted>> runs;
  for (const Scene& scene : others) {
    expect_whole(scene);
    if (scene.method.step != step)
      throw InputError("/method/step_s", "expected the fine run's, " + std::to_string(step) +
                                             ", got " + std::to_string(scene.method.step));
    runs.push_back(std::make_unique<Restarted>(scene, fine_mesh));
  }
  const std::int64_t n_after = whole_steps(options.after, step);
  const std::int64_t n_between = std::max(n_after, whole_steps(options.begin, step)) - n_after;
  const std::int64_t n_all = whole_steps(options.duration, step);
  std::vector<std::vector<double>> errors(runs.size());
  // The fine run waits for the others at each start and end. It starts anew as they do, since a
  // stepper forgets how solids touched the cloth.
  for (std::int64_t begin = n_between; begin + n_after <= n_all; begin += n_between + n_after) {
    if (!run(reference, n_between)) break;
    for (const auto& other : runs) other->start(reference);
    const State state = reference.state();
    reference.go_on_from(state, reference.time(), reference.contact_accelerations());
    if (!run(reference, n_after)) break;
    for (std::size_t k = 0; k < runs.size(); ++k) {
      Restarted& other = *runs[k];
      const bool is_whole = run(other.simulation, n_after);
      errors[k].push_back(is_whole
                              ? position_error(other.simulation.state().positions,
                                               other.sampling.sampled(reference.state().positions),
                                               other.areas)
                              : std::numeric_limits<double>::infinity());
    }
  }
  return errors;
}

}  // namespace pleat
