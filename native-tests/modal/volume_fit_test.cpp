#include "core/modal/volume_fit.h"

#include <catch2/catch.hpp>

#include "core/modal/arap_energy.h"
#include "native-tests/support/bars.h"

using namespace pleat;

TEST_CASE("volume_fit: a rigid motion of the surface is one of the volume", "[modal]") {
  const FineBox box({1, 0.2, 0.2});
  const CarryingVolume bar = lattice_volume(box.positions, box.triangles, 0.1);
  const Mat3 turn = Eigen::AngleAxisd(2.5, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  const auto moved = [&](const Positions& places) -> Positions {
    return (turn * places).colwise() + Vec3(3, 0, -1);
  };
  Positions volume = bar.volume.rest_positions;
  CHECK(VolumeFit(bar, 1e4).fit(moved(box.positions), volume).ok());
  CHECK((volume - moved(bar.volume.rest_positions)).cwiseAbs().maxCoeff() < 1e-6);
}

TEST_CASE("volume_fit: a bent surface bends its volume, nearer the harder it pulls", "[modal]") {
  const FineBox box({1, 0.2, 0.2});
  const CarryingVolume bar = lattice_volume(box.positions, box.triangles, 0.05);
  const Positions wanted = bent(box.positions, 3.14159);
  double before = 1;
  for (const double attachment : {1.0, 100.0, 1e5}) {
    Positions volume = bar.volume.rest_positions;
    CHECK(VolumeFit(bar, attachment).fit(wanted, volume).ok());
    const double off = (bar.surface(volume) - wanted).colwise().norm().maxCoeff();
    CAPTURE(attachment, off);
    CHECK(off < before / 4);
    before = off;
    for (const Tet& tet : bar.volume.tets) CHECK(tet_volume(volume, tet) > 0);
  }
  CHECK(before < 1.2e-3);  // cubes of 5 cm miss an arc of radius 1/pi by its sagitta, 1 mm
}

TEST_CASE("volume_fit: where it ends, no force is left", "[modal]") {
  const FineBox box({0.4, 0.2, 0.2});
  const CarryingVolume bar = lattice_volume(box.positions, box.triangles, 0.1);
  const Positions wanted = bent(box.positions, 1);
  constexpr double kAttachment = 100;
  Positions volume = bar.volume.rest_positions;
  REQUIRE(VolumeFit(bar, kAttachment).fit(wanted, volume).ok());
  Positions forces;
  ArapEnergy(bar.volume, 1).energy_and_gradient(volume, forces);
  const double elastic = forces.norm();
  const double whole = total_volume(bar.volume, bar.volume.rest_positions);
  forces += 2 * kAttachment * whole / static_cast<double>(wanted.cols()) *
            (bar.surface(volume) - wanted) * bar.embedding.transpose();
  CHECK(elastic > 1e-4);
  CHECK(forces.norm() < 1e-5 * elastic);
}
