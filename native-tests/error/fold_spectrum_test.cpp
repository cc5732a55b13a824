#include "core/error/fold_spectrum.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/mesh/quad_mesh.h"

namespace pleat {
namespace {

constexpr double kTurn = 2 * 3.14159265358979323846;
constexpr double kTubeRadius = 0.2;
constexpr double kTubeHeight = 0.6;

/// A ring about (1, 2, 3), tilted, with waves that stand out from it.
Positions wavy_ring(int n_points, int n_waves, double amplitude) {
  const Eigen::AngleAxisd tilt(0.4, Vec3(1, 2, 0.5).normalized());
  Positions ring(3, n_points);
  for (int p = 0; p < n_points; ++p) {
    const double s = kTurn * p / n_points;
    const double radius = kTubeRadius + amplitude * std::cos(n_waves * s + 0.3);
    ring.col(p) = Vec3(1, 2, 3) + tilt * (radius * Vec3(std::cos(s), 0, std::sin(s)));
  }
  return ring;
}

/// A tube of quads round the y axis, which closes.
QuadMesh tube(int columns, int rows) {
  QuadPatch patch;
  patch.rest_positions.resize(3, columns * (rows + 1));
  patch.rest_coordinates.resize(2, columns * (rows + 1));
  for (int r = 0; r <= rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double s = kTurn * c / columns;
      patch.rest_positions.col(r * columns + c) << kTubeRadius * std::cos(s),
          kTubeHeight * (1 - static_cast<double>(r) / rows), kTubeRadius * std::sin(s);
      patch.rest_coordinates.col(r * columns + c) << kTubeHeight * r / rows, kTubeRadius * s;
    }
  }
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const int next = (c + 1) % columns;
      patch.quads.push_back({VertexId(r * columns + c), VertexId((r + 1) * columns + c),
                             VertexId((r + 1) * columns + next), VertexId(r * columns + next)});
    }
  }
  return QuadMesh::from_patch(patch);
}

/// The tube's shape with waves all down, and what its vertices are then.
Positions waved(const QuadMesh& mesh, int n_waves, double amplitude) {
  Positions x = mesh.rest_positions();
  for (auto place : x.colwise()) {
    const double s = std::atan2(place.z(), place.x());
    const double factor = 1 + amplitude / kTubeRadius * std::cos(n_waves * s);
    place.x() *= factor;
    place.z() *= factor;
  }
  return x;
}

}  // namespace

TEST_CASE("fold spectrum: waves around a ring are told by number and amplitude", "[error]") {
  const int n_waves = GENERATE(3, 4, 11, 20);
  constexpr double kAmplitude = 0.013;
  const FoldAmplitudes found = fold_amplitudes(wavy_ring(64, n_waves, kAmplitude));
  for (int k = kFewestFolds; k <= kMostFolds; ++k) {
    CAPTURE(n_waves, k);
    CHECK(found[k - kFewestFolds] == Approx(k == n_waves ? kAmplitude : 0).margin(1e-12));
  }
}

TEST_CASE("fold spectrum: a ring goes once around cloth, at equal steps", "[error]") {
  const TriangleMesh mesh = tube(40, 6).triangle_mesh();
  const std::vector<Positions> rings = rest_rings(mesh, 0.37 * kTubeHeight, 50);
  REQUIRE(rings.size() == 1);
  const Positions& ring = rings.front();
  CHECK((ring.row(1).array() - 0.37 * kTubeHeight).abs().maxCoeff() < 1e-12);
  double turns = 0;
  for (int p = 0; p < 50; ++p) {
    const Vec3 a = ring.col(p);
    const Vec3 b = ring.col((p + 1) % 50);
    CHECK((b - a).norm() == Approx(kTurn * kTubeRadius / 50).epsilon(0.005));
    turns += std::atan2(a.x() * b.z() - a.z() * b.x(), a.x() * b.x() + a.z() * b.z()) / kTurn;
  }
  CHECK(std::abs(turns) == Approx(1));
  CHECK(rest_rings(mesh, 2 * kTubeHeight, 50).empty());
  SheetShape sheet;
  CHECK(rest_rings(QuadMesh::sheet(sheet).triangle_mesh(), -0.5, 50).empty());  // no closed line
}

TEST_CASE("fold spectrum: one shape on two meshes has one spectrum, others their difference",
          "[error]") {
  const QuadMesh coarse = tube(60, 5);
  const QuadMesh fine = tube(240, 20);
  const std::vector<Positions> rings = garment_rings(fine.triangle_mesh());
  REQUIRE(rings.size() == 3);
  FoldSpectrum on_coarse(coarse.triangle_mesh(), rings);
  FoldSpectrum on_fine(fine.triangle_mesh(), rings);
  FoldSpectrum lower(fine.triangle_mesh(), rings);
  constexpr double kAmplitude = 0.02;
  for (const double share : {0.6, 0.8}) {  // root mean square over both: sqrt(0.5)
    on_coarse.add(waved(coarse, 7, share * kAmplitude));
    on_fine.add(waved(fine, 7, share * kAmplitude));
    lower.add(waved(fine, 7, share * kAmplitude / 2));
  }
  const double pooled = std::sqrt(0.5) * kAmplitude;
  CHECK(on_fine.amplitudes()(7 - kFewestFolds, 1) == Approx(pooled).epsilon(0.01));
  CHECK(fold_distance(on_fine.amplitudes(), on_fine.amplitudes()) == 0);
  // Chords of 60 around 7 waves cut (7 pi / 60)^2 / 3 = 4.5 % of the amplitude off.
  CHECK(fold_distance(on_coarse.amplitudes(), on_fine.amplitudes()) < 0.06 * pooled);
  CHECK(fold_distance(lower.amplitudes(), on_fine.amplitudes()) ==
        Approx(pooled / 2).epsilon(0.01));
}

}  // namespace pleat
