#include "core/run/convergence_study.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "core/base/check.h"
#include "core/dynamics/stepper_table.h"
#include "core/mesh/triangle_mesh.h"
#include "core/run/simulation.h"
#include "core/scene/sheet_cloth.h"
#include "core/scene/tearing.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

ConvergenceOptions few_rounds() {
  ConvergenceOptions options;
  options.methods = {steppers::kPbd.usual_method(), steppers::kHpbd.usual_method()};
  options.most_rounds = 3;
  return options;
}

std::string refused_at(const Scene& scene, const ConvergenceOptions& options) {
  try {
    study_convergence(scene, options);
  } catch (const InputError& error) {
    return error.where();
  }
  return "nowhere";
}

}  // namespace

TEST_CASE("convergence study: the springs of torn cloth are the edges of its own surface",
          "[run]") {
  Scene scene = released_sheet_scene(6, "fine cotton");
  scene.cloth = SheetCloth(SheetShape{1, 1, 6, 6});
  scene.pins.push_back({"lower_left", {Motion::Kind::move, {-0.6, -0.6, 0.3}, 0, 1, 0}});
  auto tearing = std::make_shared<Tearing>();
  tearing->breaking_elongation = 0.2;
  scene.model.tearing = tearing;
  ConvergenceOptions options = few_rounds();
  options.time = 1;
  Simulation simulation(scene);
  while (simulation.time() < options.time - scene.method.step / 2) simulation.step();
  REQUIRE(!simulation.tear_origins().empty());
  const ConvergenceStudy study = study_convergence(scene, options);
  CHECK(study.n_vertices == simulation.model().n_vertices());
  CHECK(study.n_springs == static_cast<int>(mesh_edges(simulation.triangles()).size()));
}

TEST_CASE("convergence study: after a solve that took too long a method gets no more rounds",
          "[run]") {
  ConvergenceOptions options = few_rounds();
  options.targets.clear();
  const Scene scene = released_sheet_scene(4, "fine cotton");
  for (const ConvergenceSeries& series : study_convergence(scene, options).series)
    CHECK(series.points.size() == 3);
  options.longest_solve = 1e-12;
  for (const ConvergenceSeries& series : study_convergence(scene, options).series)
    CHECK(series.points.size() == 1);
}

TEST_CASE("convergence study: what is heard of it rises to one", "[run]") {
  ConvergenceOptions options = few_rounds();
  options.time = 0.05;
  std::vector<double> heard;
  options.on_progress = [&](double done) { heard.push_back(done); };
  study_convergence(released_sheet_scene(4, "fine cotton"), options);
  // Three steps, two methods, three numbers of rounds.
  REQUIRE(heard.size() == 8);
  CHECK(std::is_sorted(heard.begin(), heard.end()));
  CHECK(heard.back() == 1);
}

TEST_CASE("convergence study: what cannot be studied is told before the run", "[run]") {
  ConvergenceOptions options = few_rounds();
  options.time = 1e6;  // a run that would not end
  Scene membrane = released_sheet_scene(4, "fine cotton");
  membrane.model.elasticity = Elasticity::membrane;
  membrane.model.bending = BendingModel::fitted;
  CHECK(refused_at(membrane, options) == "/model");
}

}  // namespace pleat
