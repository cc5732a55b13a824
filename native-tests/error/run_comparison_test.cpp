#include "core/error/run_comparison.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/scene/cloth/particle_cloth.h"
#include "native-tests/support/meshes.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

Scene sheet_scene(int level) {
  Scene scene = released_sheet_scene(4, "fine cotton");
  scene.level = level;
  return scene;
}

/// The sheet bent to a cylinder about its weft and moved, at two times.
std::vector<Sample> bent_run(int level, double turn, const Vec3& shift) {
  const Positions rest = rest_cloth(sheet_scene(level), level).mesh.rest_positions;
  Positions x(3, rest.cols());
  for (Eigen::Index i = 0; i < rest.cols(); ++i) {
    const double u = rest(2, i);  // coordinate along warp
    const Vec3 place(rest(0, i), turn > 0 ? (1 - std::cos(turn * u)) / turn : 0,
                     turn > 0 ? std::sin(turn * u) / turn : u);
    x.col(i) = place + shift;
  }
  return {{0.5, x, {}}, {1, x, {}}};
}

}  // namespace

TEST_CASE("run_comparison: a run is no different from itself, at any level", "[error]") {
  const int level = GENERATE(0, 1, 2);
  const auto run = bent_run(level, 0.8, Vec3::Zero());
  const RunErrors errors = RunComparison(sheet_scene(level), level).errors(run, run);
  CHECK(errors.position == 0);
  CHECK(errors.surface_rms < 1e-12);
  CHECK(errors.bend_distribution == 0);
}

TEST_CASE("run_comparison: a shift is seen by positions and surfaces, not by bending", "[error]") {
  const auto run = bent_run(1, 0, Vec3(0, 0.03, 0));  // shift across the flat sheet
  const auto reference = bent_run(2, 0, Vec3::Zero());
  const RunErrors errors = RunComparison(sheet_scene(1), 2).errors(run, reference);
  CHECK(errors.position == Approx(0.03));
  CHECK(errors.surface_rms == Approx(0.03));
  CHECK(errors.surface_95 == Approx(0.03));
  CHECK(errors.bend_distribution < 1e-9);
}

TEST_CASE("run_comparison: bending is compared whichever run is finer", "[error]") {
  const int level = GENERATE(0, 1, 2);
  const auto flat = bent_run(level, 0, Vec3::Zero());
  const auto bent = bent_run(1, 0.5, Vec3::Zero());
  const RunErrors errors = RunComparison(sheet_scene(level), 1).errors(flat, bent);
  CAPTURE(level);
  // Curvature 0.5 1/m everywhere against none; smoothing takes a hundredth of it at most.
  CHECK(errors.bend_distribution == Approx(0.5).epsilon(0.02));
  CHECK(errors.bend_regions == Approx(0.5).epsilon(0.02));
}

TEST_CASE("run_comparison: a shift is seen between meshes of different bases", "[error]") {
  const double shift = GENERATE(0.0, 0.002, 0.07);
  CAPTURE(shift);
  const Scene own = released_sheet_scene(5, "fine cotton");
  const Scene reference = sheet_scene(1);
  const Positions rest = rest_cloth(own).mesh.rest_positions;
  const std::vector<Sample> run{{1, rest.colwise() + Vec3(0, shift, 0), {}}};
  const std::vector<Sample> right{{1, rest_cloth(reference).mesh.rest_positions, {}}};
  const RunErrors errors = RunComparison(own, reference).errors(run, right);
  CHECK(errors.position == Approx(shift).margin(1e-12));
  CHECK(errors.surface_rms == Approx(shift).margin(1e-12));
  CHECK(errors.surface_95 == Approx(shift).margin(1e-12));
  CHECK(errors.bend_distribution < 1e-9);
}

TEST_CASE("run_comparison: bending between meshes of different bases is that of the cylinder",
          "[error]") {
  Scene own = released_sheet_scene(5, "fine cotton");
  own.level = 2;
  const std::vector<Sample> flat{{1, rest_cloth(own).mesh.rest_positions, {}}};
  auto bent = bent_run(2, 0.5, Vec3::Zero());
  bent.resize(1);
  bent[0].time = 1;
  const RunErrors errors = RunComparison(own, sheet_scene(2)).errors(flat, bent);
  CHECK(errors.bend_distribution == Approx(0.5).epsilon(0.02));
}

TEST_CASE("run_comparison: over all times, bends that trade places are the same", "[error]") {
  auto run = bent_run(2, 0.5, Vec3::Zero());
  run[0].positions = bent_run(2, 0.2, Vec3::Zero())[0].positions;
  auto reference = run;
  std::swap(reference[0].positions, reference[1].positions);
  const RunComparison comparison(sheet_scene(2), 2);
  CHECK(comparison.errors(run, reference).bend_distribution == Approx(0.3).epsilon(0.02));
  CHECK(comparison.bend_over_time(run, reference) < 1e-9);
  const auto flat = bent_run(2, 0, Vec3::Zero());
  CHECK(comparison.bend_over_time(run, flat) == Approx(0.35).epsilon(0.02));
}

TEST_CASE("run_comparison: particles have places alone", "[error]") {
  ParticleCloth cloth;
  cloth.positions = Positions::Random(3, 4);
  cloth.masses = Eigen::VectorXd::Ones(4);
  cloth.velocities = Positions::Zero(3, 4);
  Scene scene;
  scene.cloth = cloth;
  const std::vector<Sample> run{{1, cloth.positions.colwise() + Vec3(0, 2, 0), {}}};
  const std::vector<Sample> reference{{1, cloth.positions, {}}};
  const RunErrors errors = RunComparison(scene, 0).errors(run, reference);
  CHECK(errors.position == Approx(2));
  CHECK(std::isnan(errors.surface_rms));
  CHECK(std::isnan(errors.bend_distribution));
}

TEST_CASE("run_comparison: runs at other times are refused", "[error]") {
  auto run = bent_run(0, 0, Vec3::Zero());
  const auto reference = run;
  run[1].time = 2;
  CHECK_THROWS_AS(RunComparison(sheet_scene(0), 0).errors(run, reference), ContractError);
  run.pop_back();
  CHECK_THROWS_AS(RunComparison(sheet_scene(0), 0).errors(run, reference), ContractError);
}

}  // namespace pleat
