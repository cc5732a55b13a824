#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "core/base/random.h"
#include "core/base/simd.h"
#include "core/dynamics/position_based/levels/attachments.h"
#include "core/dynamics/position_based/levels/coarse_levels.h"
#include "native-tests/support/meshes.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

/// Places of four numbers each, and one that is nobody's, as the programs take them.
std::vector<double> in_fours(const Positions& x) {
  std::vector<double> numbers(4 * static_cast<std::size_t>(x.cols() + 1), 0);
  for (Eigen::Index v = 0; v < x.cols(); ++v)
    for (Eigen::Index k = 0; k < 3; ++k) numbers[static_cast<std::size_t>(4 * v + k)] = x(k, v);
  return numbers;
}

Positions from_fours(const std::vector<double>& numbers) {
  Positions x(3, static_cast<Eigen::Index>(numbers.size() / 4) - 1);
  for (Eigen::Index v = 0; v < x.cols(); ++v)
    for (Eigen::Index k = 0; k < 3; ++k) x(k, v) = numbers[static_cast<std::size_t>(4 * v + k)];
  return x;
}

Positions random_positions(int n, Random& random) {
  Positions x(3, n);
  for (double& number : x.reshaped()) number = random.uniform(-1, 1);
  return x;
}

/// A substep that begins at `begin` and has come to `now` so far; what a sweep makes of it.
Positions swept(LengthGroups<Double4>& lengths, const Positions& begin, const Positions& now,
                const Relaxation& relaxation = {}) {
  std::vector<double> moves = in_fours(now - begin);
  lengths.sweep(in_fours(begin).data(), moves.data(), relaxation);
  return begin + from_fours(moves);
}

std::vector<int> in_order(int n) {
  std::vector<int> places(static_cast<std::size_t>(n));
  std::iota(places.begin(), places.end(), 0);
  return places;
}

MeshHierarchy levels_of(const TriangleMesh& mesh, const std::vector<bool>& is_fixed = {}) {
  HierarchyOptions options;
  options.ratio = 0.4;
  return mesh_hierarchy(mesh, is_fixed, options);
}

Positions corrected(const MeshHierarchy& hierarchy, const std::vector<double>& inverse_masses,
                    LevelLengths lengths, const Positions& begin, const Positions& now,
                    const CycleSmoothing& smoothing = {}) {
  CoarseLevels<Double4> levels(hierarchy, in_order(static_cast<int>(begin.cols())), inverse_masses,
                               lengths);
  std::vector<double> moves = in_fours(now - begin);
  levels.correct(in_fours(begin).data(), moves.data(), smoothing);
  return begin + from_fours(moves);
}

}  // namespace

TEST_CASE("independent sets: each element is in one, and no two of a set share what moves",
          "[dynamics]") {
  Random random(GENERATE(1U, 2U, 3U));
  constexpr int kPlaces = 40;
  std::vector<PlacePair> elements;
  while (elements.size() < 200) {
    const int a = static_cast<int>(random.below(kPlaces)),
              b = static_cast<int>(random.below(kPlaces));
    if (a != b) elements.push_back({a, b});
  }
  std::vector<bool> moves(kPlaces, true);
  moves[0] = false;
  std::vector<int> times(elements.size(), 0);
  for (const std::vector<int>& set : independent_sets(elements, moves)) {
    std::vector<bool> is_taken(kPlaces, false);
    for (const int e : set) {
      ++times[static_cast<std::size_t>(e)];
      for (const int place : elements[static_cast<std::size_t>(e)]) {
        CHECK((place == 0 || !is_taken[static_cast<std::size_t>(place)]));
        is_taken[static_cast<std::size_t>(place)] = true;
      }
    }
  }
  CHECK(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
}

TEST_CASE("lengths: what holds still has them after one sweep, shared by inverse mass",
          "[dynamics]") {
  Positions x(3, 2);
  x << 0, 3, 0, 0, 0, 0;
  LengthGroups<Double4> lengths({{{0, 1}, 2}}, {1, 3, 0}, LengthSide::both);
  // The begin is such that both directions of the pull agree, and the error small.
  x(0, 1) = 2 + 1e-6;
  const Positions after = swept(lengths, x, x);
  CHECK(after(0, 1) - after(0, 0) == Approx(2).epsilon(1e-12));
  CHECK(after(0, 0) == Approx(0.25e-6).epsilon(1e-5));
  CHECK(after(0, 1) == Approx(2 + 0.25e-6).epsilon(1e-12));
}

TEST_CASE("lengths: those that hold from above leave what is nearer alone", "[dynamics]") {
  Positions x(3, 2);
  x << 0, 1, 0, 0, 0, 0;
  LengthGroups<Double4> from_above({{{0, 1}, 2}}, {1, 1, 0}, LengthSide::longer);
  LengthGroups<Double4> both({{{0, 1}, 2}}, {1, 1, 0}, LengthSide::both);
  CHECK(swept(from_above, x, x) == x);
  CHECK(swept(both, x, x) != x);
}

TEST_CASE("lengths: what aims at its places less their strain aims at its length, however far off",
          "[dynamics]") {
  const double apart = GENERATE(0.5, 0.999, 1.001, 5.0, 40.0);
  CAPTURE(apart);
  Positions x(3, 2), at_rest(3, 2);
  x << 0, apart, 0, 0, 0, 0;
  at_rest << 0, 1, 0, 0, 0, 0;
  const std::vector<double> begins = in_fours(x), moves(begins.size(), 0);
  const LengthGroups<Double4> lengths({{{0, 1}, 1}}, {1, 1, 0}, LengthSide::both);
  std::vector<double> strains(lengths.n_strains());
  lengths.strains(begins.data(), moves.data(), strains.data());
  CHECK(strains[0] == Approx(apart - 1));
  LengthGroups<Double4> aimed({{{0, 1}, 7}}, {1, 1, 0}, LengthSide::both);
  aimed.aim_at(begins.data(), moves.data(), strains.data());
  std::vector<double> left(aimed.n_strains());
  aimed.strains(in_fours(at_rest).data(), moves.data(), left.data());
  // 1 - e of what is squeezed is its length to first order.
  CHECK(left[0] == Approx(0).margin(apart < 1 ? 1.001 * (1 - apart) * (1 - apart) / apart : 1e-12));
}

TEST_CASE("lengths: every smoother keeps momentum, and sor moves omega times as far",
          "[dynamics]") {
  Random random(5);
  const Positions begin = random_positions(20, random);
  const Positions now = begin + 0.1 * random_positions(20, random);
  std::vector<PlaceLength> all;
  std::vector<double> inverse_masses;
  Eigen::VectorXd masses(20);
  for (int v = 0; v < 20; ++v) {
    masses[v] = random.uniform(0.5, 2);
    inverse_masses.push_back(1 / masses[v]);
    all.push_back({{v, (v + 7) % 20}, 1});
  }
  inverse_masses.push_back(0);
  LengthGroups<Double4> lengths(all, inverse_masses, LengthSide::both);
  for (const Smoother smoother : {Smoother::gauss_seidel, Smoother::sor}) {
    const Positions after = swept(lengths, begin, now, {smoother, 1.3});
    CHECK((after - now).norm() > 0.1);
    CHECK(((after - now) * masses).norm() < 1e-12);
  }
  LengthGroups<Double4> one({{{0, 1}, 1}}, {1, 1, 0}, LengthSide::both);
  const Positions pair = now.leftCols(2), pair_begin = begin.leftCols(2);
  const Positions plain = swept(one, pair_begin, pair) - pair;
  const Positions relaxed = swept(one, pair_begin, pair, {Smoother::sor, 1.3}) - pair;
  CHECK((relaxed - 1.3 * plain).norm() < 1e-14);
}

TEST_CASE("lengths: jacobi takes the mean of what each constraint alone would do", "[dynamics]") {
  Random random(6);
  const Positions begin = random_positions(3, random);
  const Positions now = begin + 0.1 * random_positions(3, random);
  const std::vector<double> inverse_masses = {1, 2, 3, 0};
  const std::vector<PlaceLength> all = {{{0, 1}, 1}, {{1, 2}, 1}};
  Positions mean = now;
  const std::array<double, 3> counts = {1, 2, 1};
  for (const PlaceLength& length : all) {
    LengthGroups<Double4> alone({length}, inverse_masses, LengthSide::both);
    const Positions change = swept(alone, begin, now) - now;
    for (Eigen::Index v = 0; v < 3; ++v)
      mean.col(v) += 0.8 * change.col(v) / counts[static_cast<std::size_t>(v)];
  }
  LengthGroups<Double4> lengths(all, inverse_masses, LengthSide::both);
  CHECK((swept(lengths, begin, now, {Smoother::jacobi, 0.8}) - mean).norm() < 1e-14);
}

TEST_CASE("lengths: a sweep damps each wave as local Fourier analysis says", "[dynamics]") {
  constexpr int kLengths = 200;
  constexpr double kError = 1e-6;
  const double cosine = GENERATE(0.8, 0.3, 0.0, -0.4, -0.5, -0.9, -1.0);
  const double omega = GENERATE(0.7, 1.0, 1.3);
  CAPTURE(cosine, omega);
  // Along a straight chain errors of lengths are linear in moves: wave k is cos(k theta).
  const double theta = std::acos(cosine);
  std::vector<PlaceLength> all;
  Positions x = Positions::Zero(3, kLengths + 1);
  for (int k = 0; k < kLengths; ++k) {
    all.push_back({{k, k + 1}, 1});
    x(0, k + 1) = x(0, k) + 1 + kError * std::cos(k * theta);
  }
  std::vector<double> inverse_masses(kLengths + 1, 1.0);
  inverse_masses.push_back(0);
  const auto check = [&](Smoother smoother, int k, double damping) {
    LengthGroups<Double4> lengths(all, inverse_masses, LengthSide::both);
    const Positions after = swept(lengths, x, x, {smoother, omega});
    const double left = after(0, k + 1) - after(0, k) - 1;
    CHECK(left / kError == Approx(damping * std::cos(k * theta)).margin(1e-5));
  };
  // Every second length first, then those between.
  const double between = 1 + omega * cosine;
  check(Smoother::sor, 100, 1 - omega + omega * cosine * between);
  check(Smoother::sor, 101, (1 - omega) * between);
  for (const int k : {100, 101}) check(Smoother::jacobi, k, 1 - omega / 2 * (1 - cosine));
}

TEST_CASE("coarse levels: strain-free cloth is left alone, rolled or folded", "[dynamics]") {
  const auto pattern = GENERATE(Triangulation::one_way, Triangulation::jittered);
  const double radius = GENERATE(0.05, 0.2, 1.0);
  CAPTURE(static_cast<int>(pattern), radius);
  const TriangleMesh mesh = triangulated_sheet(pattern, 20, 20, 0.05);
  const std::vector<double> inverse_masses(static_cast<std::size_t>(mesh.n_vertices()), 1);
  // Chords of a cylinder are shorter than its arcs, so no coarse length is exceeded.
  const Positions rolled = on_cylinder(mesh.rest_positions, 0.3, radius);
  CycleSmoothing cycle;
  cycle.before = {Smoother::sor, 1.1};
  const Positions after = corrected(levels_of(mesh), inverse_masses, LevelLengths::surface,
                                    mesh.rest_positions, rolled, cycle);
  CHECK((after - rolled).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("coarse levels: chords keep a tube from being laid flat, surface lengths do not",
          "[dynamics]") {
  TriangleMesh mesh = triangulated_sheet(Triangulation::one_way, 16, 16, 0.05);
  const Positions flat = mesh.rest_positions;
  mesh.pattern = pattern_of(mesh);
  mesh.rest_positions = on_cylinder(flat, 0, 0.15);
  const MeshHierarchy hierarchy = levels_of(mesh);
  const std::vector<double> inverse_masses(static_cast<std::size_t>(mesh.n_vertices()), 1);
  const auto moved = [&](LevelLengths lengths) {
    return (corrected(hierarchy, inverse_masses, lengths, flat, flat) - flat).cwiseAbs().maxCoeff();
  };
  CHECK(moved(LevelLengths::surface) < 1e-12);
  CHECK(moved(LevelLengths::chord) > 1e-4);
}

TEST_CASE("coarse levels: their corrections keep momentum, and what is fixed stays", "[dynamics]") {
  Random random(9);
  const TriangleMesh mesh = triangulated_sheet(Triangulation::crossed, 10, 10, 0.1);
  const int n = mesh.n_vertices();
  Eigen::VectorXd masses(n);
  std::vector<double> inverse_masses;
  for (double& mass : masses) {
    mass = random.uniform(0.5, 2);
    inverse_masses.push_back(1 / mass);
  }
  const Positions stretched = 1.2 * mesh.rest_positions + 0.01 * random_positions(n, random);
  const Positions after = corrected(levels_of(mesh), inverse_masses, LevelLengths::surface,
                                    mesh.rest_positions, stretched);
  CHECK((after - stretched).norm() > 0.1);
  CHECK(((after - stretched) * masses).norm() < 1e-12);

  std::vector<bool> is_fixed(static_cast<std::size_t>(n), false);
  for (const int v : {0, 5, n - 1}) {
    is_fixed[static_cast<std::size_t>(v)] = true;
    inverse_masses[static_cast<std::size_t>(v)] = 0;
  }
  const Positions held = corrected(levels_of(mesh, is_fixed), inverse_masses, LevelLengths::surface,
                                   mesh.rest_positions, stretched);
  for (const int v : {0, 5, n - 1}) CHECK(held.col(v) == stretched.col(v));
  CHECK((held - stretched).norm() > 0.1);
}

TEST_CASE("coarse levels: by errors, what has none is left alone, stretched and folded as it is",
          "[dynamics]") {
  Random random(11);
  const TriangleMesh mesh = triangulated_sheet(Triangulation::alternating, 16, 16, 0.05);
  const std::vector<double> inverse_masses(static_cast<std::size_t>(mesh.n_vertices()), 1);
  const MeshHierarchy hierarchy = levels_of(mesh);
  StrainedEdges edges;
  for (const LevelEdge& edge : hierarchy.levels[0].edges) {
    edges.places.push_back(static_cast<int>(edges.ends.size()));
    edges.ends.push_back({edge.a, edge.b});
  }
  CoarseLevels<Double4> levels(hierarchy, in_order(mesh.n_vertices()), inverse_masses, edges,
                               mesh.rest_positions);
  const Positions crumpled = 1.3 * on_cylinder(mesh.rest_positions, 0.3, 0.1) +
                             0.01 * random_positions(mesh.n_vertices(), random);
  const auto moved = [&](const Positions& now, const std::vector<double>& strains) {
    std::vector<double> moves = in_fours(now - mesh.rest_positions);
    levels.correct(in_fours(mesh.rest_positions).data(), moves.data(), {}, strains.data());
    return Positions(mesh.rest_positions + from_fours(moves));
  };
  const std::vector<double> none(edges.ends.size(), 0);
  CHECK((moved(crumpled, none) - crumpled).cwiseAbs().maxCoeff() < 1e-12);

  // A correction of a sheet that is 1 % too long both ways mends most where it is asked for.
  const std::vector<double> too_long(edges.ends.size(), 0.01);
  const Positions stretched = 1.01 * mesh.rest_positions;
  const Positions after = moved(stretched, too_long);
  const double diagonal = box_diagonal(mesh.rest_positions);
  CHECK(box_diagonal(after) < 1.004 * diagonal);
  CHECK(box_diagonal(after) > 0.996 * diagonal);
  const Vec3 drift = (after - stretched).rowwise().mean();
  CHECK(drift.norm() < 1e-12);
}

TEST_CASE("strain rows: they are means, along threads of the strain along them", "[dynamics]") {
  const TriangleMesh mesh = triangulated_sheet(Triangulation::alternating, 8, 8, 0.1);
  StrainedEdges fine, coarse;
  std::vector<double> strains;
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    const Vec3 along =
        (mesh.rest_positions.col(edge.a) - mesh.rest_positions.col(edge.b)).normalized();
    fine.places.push_back(static_cast<int>(fine.ends.size()));
    fine.ends.push_back({edge.a, edge.b});
    strains.push_back(0.03 * along.x() * along.x());  // stretched along x alone
  }
  const auto at = [&](double x, double y) {
    Eigen::Index v = 0;
    (mesh.rest_positions.colwise() - Vec3(x, y, 0)).colwise().norm().minCoeff(&v);
    return VertexId(v);
  };
  coarse.ends = {{at(0.2, 0.4), at(0.4, 0.4)}, {at(0.4, 0.2), at(0.4, 0.4)}};
  coarse.places = {1, 0};
  std::vector<double> found(2, -1);
  const StrainRows rows = strain_rows(coarse, fine, mesh.rest_positions);
  rows.apply(strains.data(), found.data());
  CHECK(found[1] == Approx(0.03).epsilon(0.1));
  CHECK(found[0] == Approx(0).margin(0.003));
  std::fill(strains.begin(), strains.end(), 0.02);
  rows.apply(strains.data(), found.data());
  CHECK(found[0] == Approx(0.02));
  CHECK(found[1] == Approx(0.02));
}

TEST_CASE("attachments: on a flat sheet they are straight, to the nearest pin of each patch",
          "[dynamics]") {
  const QuadMesh mesh = lying_sheet(6);
  ClothModel model = sheet_model(mesh, soft_fabric());
  model.surface.rest_positions = mesh.rest_positions();
  model.surface.triangles = mesh.triangles();
  model.rest_coordinates = mesh.rest_coordinates();
  const Positions& x = mesh.rest_positions();
  // One corner alone, and two neighbours at another corner.
  const auto nearest_to = [&](double u, double v) {
    Eigen::Index at = 0;
    (model.rest_coordinates.colwise() - Eigen::Vector2d(u, v)).colwise().norm().minCoeff(&at);
    return VertexId(at);
  };
  const Eigen::Vector2d end = model.rest_coordinates.rowwise().maxCoeff();
  const std::vector<VertexId> pins = {nearest_to(0, 0), nearest_to(end[0], end[1]),
                                      nearest_to(end[0], end[1] - end[1] / 6)};
  for (const VertexId v : pins) model.pins.push_back({v, x.col(v), {}});
  const std::vector<PlaceLength> lengths = long_range_attachments(model, {});
  CHECK(lengths.size() == 2 * static_cast<std::size_t>(model.n_vertices() - 3));
  for (const auto& [places, length] : lengths) {
    const Vec3 vertex = x.col(places[0]);
    CHECK(length == Approx((vertex - x.col(places[1])).norm()).epsilon(1e-9));
    if (places[1] == pins[0]) continue;
    const double nearest =
        std::min((vertex - x.col(pins[1])).norm(), (vertex - x.col(pins[2])).norm());
    CHECK(length == Approx(nearest).epsilon(1e-9));
  }
}

TEST_CASE("attachments: elsewhere they are never shorter than the surface allows", "[dynamics]") {
  const QuadMesh mesh = lying_sheet(8);
  ClothModel model = sheet_model(mesh, soft_fabric());
  model.rest_coordinates.resize(2, 0);
  const Positions& x = mesh.rest_positions();
  model.pins.push_back({VertexId(0), x.col(0), {}});
  double most = 0;
  for (const auto& [places, length] : long_range_attachments(model, {})) {
    const double straight = (x.col(places[0]) - x.col(places[1])).norm();
    CHECK(length >= straight - 1e-12);
    most = std::max(most, length / straight);
  }
  CHECK(most < 1.09);  // a path of edges and diagonals is 8 % longer at worst
}

TEST_CASE("attachments: what is too far away comes back along its way, and nothing else moves",
          "[dynamics]") {
  // Slots 0 to 3: two pins, a vertex beyond its length to the first, one within.
  const std::vector<int> slots = {0, 1, 2, 3};
  std::array<std::vector<float>, 3> begins, moves;
  for (std::vector<float>& row : begins) row.assign(4, 0);
  for (std::vector<float>& row : moves) row.assign(4, 0);
  begins[0] = {0, 1, 0.5f, 0.5f};
  moves[0][2] = 1e-3f;
  const std::vector<float> inverse_masses = {0, 0, 1, 1};
  const LaneView view{{moves[0].data(), moves[1].data(), moves[2].data()},
                      {begins[0].data(), begins[1].data(), begins[2].data()},
                      inverse_masses.data()};
  const AttachmentProgram program({{{2, 0}, 0.5}, {{2, 1}, 0.6}, {{3, 0}, 0.5}, {{3, 1}, 0.5}},
                                  slots, 0);
  CHECK(program.sweep(view) == 1);
  CHECK(begins[0][2] + moves[0][2] == Approx(0.5).epsilon(1e-5));
  CHECK(moves[0][3] == 0);
  CHECK(moves[0][0] == 0);
  CHECK(moves[0][1] == 0);

  // Pins a hundredth further apart than the shorter pair of lengths: all lengths grow by that.
  moves[0] = {-5e-3f, 5e-3f, 6e-3f, 0};
  CHECK(program.sweep(view) == Approx(1.01));
  CHECK(begins[0][2] + moves[0][2] == Approx(0.505 - 0.005).epsilon(1e-4));
  CHECK(moves[0][3] == Approx(0).margin(1e-6));
}

}  // namespace pleat
