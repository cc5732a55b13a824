#include "core/contact/motion_guard.h"

#include <catch2/catch.hpp>

#include "core/base/random.h"
#include "native-tests/support/exact_pairs.h"

namespace pleat {
namespace {

constexpr double kSpacing = 0.025;  // [m]
constexpr double kGap = 0.001;      // [m]
constexpr double kSubstep = 1.0 / 240;

/// Square sheets of the same size above each other, in planes of equal y.
struct Layers {
  SelfContact surfaces;
  Positions begins;
  int side;  // vertices along an edge

  Layers(int n_layers, double gap, int n_cells = 4) : side(n_cells + 1) {
    const int n_each = side * side;
    begins.resize(3, n_layers * n_each);
    for (int layer = 0; layer < n_layers; ++layer) {
      // Turned and shifted a little: no edge lies above another.
      for (int i = 0; i < n_each; ++i) {
        const int row = i / side;
        const double u = i % side + 0.3 * layer;
        const double v = row + 0.2 * layer;
        begins.col(layer * n_each + i) << kSpacing * (u + 0.1 * v * layer), gap * layer,
            kSpacing * v;
      }
      for (int r = 0; r < n_cells; ++r)
        for (int c = 0; c < n_cells; ++c) {
          const int at = layer * n_each + r * side + c;
          add({at, at + 1, at + side + 1});
          add({at, at + side + 1, at + side});
        }
    }
    surfaces.rest_positions = begins;
    surfaces.thickness = kGap;
  }

  int n_vertices() const { return static_cast<int>(begins.cols()); }
  int n_each() const { return side * side; }

  /// Edges that go through triangles, by exact numbers, without a tree.
  int crossings(const Positions& x) const {
    int n = 0;
    for (const Triangle& a : surfaces.faces)
      for (const Triangle& b : surfaces.faces)
        for (std::size_t k = 0; k < 3; ++k) {
          const VertexId from = a[k];
          const VertexId to = a[(k + 1) % 3];
          if (std::any_of(b.begin(), b.end(), [&](VertexId v) { return v == from || v == to; }))
            continue;
          if (edge_and_triangle({x.col(from), x.col(to)},
                                {x.col(b[0]), x.col(b[1]), x.col(b[2])}) == Meeting::crossing)
            ++n;
        }
    return n;
  }

  /// Vertices that meet faces, and edges that meet edges, on straight ways.
  int meetings(const Positions& x, const Positions& y) const {
    int n = 0;
    const auto count = [&](const std::array<VertexId, 4>& v, int n_first) {
      PairMotion motion;
      motion.n_first = n_first;
      for (std::size_t k = 0; k < 4; ++k) {
        motion.begin[k] = x.col(v[k]);
        motion.end[k] = y.col(v[k]);
      }
      if (may_meet(motion)) ++n;
    };
    const auto half = [&](VertexId v) { return v < n_each(); };
    // Vertices of one layer and faces of the other; edges likewise. Neighbours are not looked at.
    for (const Triangle& t : surfaces.faces) {
      for (int i = 0; i < n_vertices(); ++i)
        if (half(VertexId(i)) != half(t[0])) count({VertexId(i), t[0], t[1], t[2]}, 1);
      for (const Triangle& u : surfaces.faces) {
        if (!half(t[0]) || half(u[0])) continue;
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t m = 0; m < 3; ++m)
            count({t[k], t[(k + 1) % 3], u[m], u[(m + 1) % 3]}, 2);
      }
    }
    return n;
  }

 private:
  void add(const std::array<int, 3>& corners) {
    surfaces.faces.push_back({VertexId(corners[0]), VertexId(corners[1]), VertexId(corners[2])});
  }
};

/// A guard of some layers, of vertices of different masses.
struct Guarded {
  const Layers& layers;
  Eigen::VectorXd masses;
  WatchedPairs pairs;
  Movers movers;
  MotionGuard guard;

  explicit Guarded(const Layers& of)
      : layers(of),
        masses(Eigen::VectorXd::LinSpaced(of.n_vertices(), 1e-3, 2e-3)),
        pairs(of.surfaces, of.n_vertices()),
        movers(masses, {}),
        guard(pairs, movers) {}

  HeldBack hold(const Positions& begins, Positions& ends, double begin = 0) {
    const double end = begin + kSubstep;
    if (!pairs.cover(ends, end)) REQUIRE(pairs.list(begins, ends, begin, end));
    return guard.hold(begins, ends, begin, end);
  }
};

/// Ways of layers that fly at each other, each vertex with a random part.
Positions meeting_ways(const Layers& layers, double speed, double noise, std::uint64_t seed) {
  Random random(seed);
  Positions ways(3, layers.n_vertices());
  for (int i = 0; i < ways.cols(); ++i) {
    const double down = i < layers.n_each() ? speed : -speed;
    for (int k = 0; k < 3; ++k) ways(k, i) = noise * random.uniform(-1, 1);
    ways(1, i) += down;
  }
  return kSubstep * ways;
}

}  // namespace

TEST_CASE("motion_guard: cloth that meets nothing is left to the bit", "[contact]") {
  const Layers layers(2, 0.05);
  Guarded guarded(layers);
  const Positions ends = layers.begins + meeting_ways(layers, 0.5, 0.5, 3);
  Positions held = ends;
  CHECK(guarded.hold(layers.begins, held).n_vertices == 0);
  CHECK(held == ends);
}

TEST_CASE("motion_guard: sheets that fly through each other do not, whatever the speed",
          "[contact]") {
  const double speed = GENERATE(0.3, 2.0, 20.0, 300.0);
  const double noise = GENERATE(0.0, 0.5, 20.0);
  CAPTURE(speed, noise);
  const Layers layers(2, 0.002, 2);
  Guarded guarded(layers);
  Positions begins = layers.begins;
  const Positions ways = meeting_ways(layers, speed, noise, 5);
  REQUIRE(layers.crossings(begins) == 0);
  for (int step = 0; step < 10; ++step) {
    Positions ends = begins + ways;
    const HeldBack held = guarded.hold(begins, ends, step * kSubstep);
    CHECK_FALSE(held.is_blocked);
    REQUIRE(layers.crossings(ends) == 0);
    REQUIRE(layers.meetings(begins, ends) == 0);
    begins = ends;
  }
}

TEST_CASE("motion_guard: a motion that all have in common changes nothing but it", "[contact]") {
  const Layers layers(2, 0.002);
  const Positions ways = meeting_ways(layers, 2, 1, 7);
  const Vec3 common(30 * kSubstep, -80 * kSubstep, 11 * kSubstep);
  Guarded standing(layers);
  Guarded flying(layers);
  Positions at_home = layers.begins + ways;
  Positions away = at_home.colwise() + common;
  const HeldBack held = standing.hold(layers.begins, at_home);
  flying.hold(layers.begins, away);
  CHECK(held.n_vertices > 0);
  CHECK((away.colwise() - common - at_home).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("motion_guard: what is held back keeps its momentum", "[contact]") {
  const Layers layers(2, 0.002);
  Guarded guarded(layers);
  const Positions proposed = layers.begins + meeting_ways(layers, 2, 1, 9);
  Positions ends = proposed;
  CHECK(guarded.hold(layers.begins, ends).n_vertices > 0);
  const Vec3 lost = (ends - proposed) * guarded.masses;
  const double size = ((proposed - layers.begins) * guarded.masses.asDiagonal()).cwiseAbs().sum();
  CHECK(lost.norm() < 1e-9 * size);
}

TEST_CASE("motion_guard: prescribed vertices go their way and push what they meet", "[contact]") {
  const Layers layers(2, 0.002);
  Guarded guarded(layers);
  std::vector<char> is_prescribed(static_cast<std::size_t>(layers.n_vertices()), 0);
  std::fill_n(is_prescribed.begin(), layers.n_each(), 1);
  guarded.movers.prescribe(is_prescribed);
  Positions ends = layers.begins;
  ends.row(1).head(layers.n_each()).array() += 0.01;
  const Positions proposed = ends;
  const HeldBack held = guarded.hold(layers.begins, ends);
  CHECK_FALSE(held.is_blocked);
  CHECK(held.n_vertices > 0);
  CHECK(ends.leftCols(layers.n_each()) == proposed.leftCols(layers.n_each()));
  CHECK(layers.crossings(ends) == 0);
  CHECK(ends.row(1).tail(layers.n_each()).maxCoeff() > 0.01);
}

TEST_CASE("motion_guard: where prescribed ways cross, nothing there moves, and it is told",
          "[contact]") {
  const Layers layers(2, 0.002);
  Guarded guarded(layers);
  guarded.movers.prescribe(std::vector<char>(static_cast<std::size_t>(layers.n_vertices()), 1));
  Positions ends = layers.begins + meeting_ways(layers, 2, 0, 1);
  CHECK(guarded.hold(layers.begins, ends).is_blocked);
  CHECK(layers.crossings(ends) == 0);
}

TEST_CASE("motion_guard: what was pushed out of its corridor meets pairs that were not listed",
          "[contact]") {
  const Layers layers(2, 0.05, 2);
  Guarded guarded(layers);
  Positions ends = layers.begins;
  REQUIRE(guarded.pairs.list(layers.begins, ends, 0, kSubstep));
  REQUIRE(guarded.pairs.pairs().empty());
  ends.row(1).head(layers.n_each()).array() += 0.06;
  CHECK(guarded.guard.hold(layers.begins, ends, 0, kSubstep).n_vertices > 0);
  CHECK(layers.crossings(ends) == 0);
  CHECK(layers.meetings(layers.begins, ends) == 0);
}

TEST_CASE("motion_guard: held as one, cloth keeps its shape and its momentum", "[contact]") {
  const Layers layers(2, 0.002);
  Guarded guarded(layers);
  const Positions proposed = layers.begins + meeting_ways(layers, 20, 500, 11);
  Positions ends = proposed;
  CHECK_FALSE(guarded.guard.hold_all(layers.begins, ends).is_blocked);
  const Positions ways = ends - layers.begins;
  CHECK((ways.colwise() - Vec3(ways.col(0))).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(((ends - proposed) * guarded.masses).norm() < 1e-9);
}

TEST_CASE("motion_guard: cloth far away changes nothing to the bit", "[contact]") {
  Layers two(2, 0.002);
  Layers three(3, 0.002);
  const int n_two = two.n_vertices();
  three.begins.leftCols(n_two) = two.begins;
  three.begins.rightCols(three.n_each()).row(1).array() += 10;
  three.surfaces.rest_positions = three.begins;
  const Positions ways = meeting_ways(two, 2, 1, 13);
  Guarded alone(two);
  Guarded beside(three);
  alone.masses.setConstant(1e-3);
  alone.movers = Movers(alone.masses, {});
  beside.masses.setConstant(1e-3);
  beside.movers = Movers(beside.masses, {});
  Positions ends = two.begins + ways;
  Positions all_ends = three.begins;
  all_ends.leftCols(n_two) = ends;
  CHECK(alone.hold(two.begins, ends).n_vertices > 0);
  beside.hold(three.begins, all_ends);
  CHECK(all_ends.leftCols(n_two) == ends);
}

}  // namespace pleat
