#include "core/contact/near_pairs.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "core/contact/closest_points.h"
#include "native-tests/support/allocation_count.h"
#include "native-tests/support/graded_sheets.h"

namespace pleat {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Cloth {
  std::vector<Triangle> faces;
  Positions places;  // [m]
  std::vector<HangingVertex> hanging;

  int n_vertices() const { return static_cast<int>(places.cols()); }
  NearPairs near_pairs() const { return {faces, hanging, n_vertices()}; }
};

Cloth cloth_of(const QuadMesh& mesh) {
  return {mesh.triangles(), mesh.rest_positions(), mesh.hanging_vertices()};
}

enum class Family {
  flat,
  folded,    ///< folded in half, 1 mm apart
  crumpled,  ///< all about a ball of a few cells
  layers,    ///< two sheets, 1 mm apart
  fast,      ///< 590 m/s for 1/60 s
  far_away,  ///< 1e4 m off
  needles,   ///< cells 1000 times as long as wide
  unused,    ///< a vertex that no face has
  graded,    ///< vertices hang
  torn       ///< two lips along the middle
};
constexpr std::array<Family, 10> kFamilies = {
    Family::flat,     Family::folded,  Family::crumpled, Family::layers, Family::fast,
    Family::far_away, Family::needles, Family::unused,   Family::graded, Family::torn};

/// Length of a cell at rest [m].
constexpr double kCell = 1.0 / 6;

Cloth cloth_in(Family family, Random& random) {
  Cloth cloth = cloth_of(family == Family::graded    ? graded_sheet(random.next())
                         : family == Family::needles ? sheet_with_aspect(5, 5, 1000)
                                                     : lying_sheet(6));
  Positions& x = cloth.places;
  if (family == Family::folded)
    for (auto place : x.colwise())
      if (place[0] > 0.5) place = Vec3(1 - place[0], place[1], 1e-3);
  if (family == Family::crumpled)
    for (auto place : x.colwise())
      place = kCell * Vec3(std::sin(9 * place[0] + place[1]), std::sin(8 * place[1] + 1),
                           std::cos(7 * place[0] - 5 * place[1]));
  if (family == Family::layers || family == Family::torn) {
    const int n = cloth.n_vertices();
    x.conservativeResize(3, 2 * n);
    x.rightCols(n) = x.leftCols(n);
    const bool is_torn = family == Family::torn;
    if (!is_torn) x.rightCols(n).row(2).array() += 1e-3;
    const std::size_t n_faces = cloth.faces.size();
    for (std::size_t f = 0; f < n_faces; ++f) {
      Triangle copy = cloth.faces[f];
      for (VertexId& v : copy) v = VertexId(v + n);
      if (!is_torn)
        cloth.faces.push_back(copy);
      else if (x.col(copy[0])[0] + x.col(copy[1])[0] + x.col(copy[2])[0] > 1.5)
        cloth.faces[f] = copy;
    }
  }
  if (family == Family::far_away) x.colwise() += Vec3(1e4, -1e4, 7e3);
  if (family == Family::unused) {
    x.conservativeResize(3, x.cols() + 1);
    x.rightCols(1) = x.leftCols(1);
  }
  return cloth;
}

/// Every vertex goes some way of its own, and has some room.
Corridors random_corridors(Family family, const Cloth& cloth, Random& random) {
  const double scale = family == Family::needles ? 2e-4 : kCell;
  Corridors corridors;
  corridors.begins = shaken(cloth.places, 0.1 * scale, random);
  corridors.ends = shaken(cloth.places, 0.3 * scale, random);
  if (family == Family::fast) corridors.ends.colwise() += Vec3(6, -5, 6);
  corridors.rooms.resize(cloth.n_vertices());
  for (double& room : corridors.rooms)
    room = random.below(4) == 0 ? 0 : random.uniform(0, 0.3) * scale;
  return corridors;
}

/// Lowest and highest number that a side may have on an axis.
struct Interval {
  double low = kInfinite, high = -kInfinite;
};

Interval interval_of(const SurfacePair& pair, int side, int axis, const Positions& x,
                     const Eigen::VectorXd& rooms) {
  Interval all;
  for (int k = side == 0 ? 0 : pair.n_first(); k < (side == 0 ? pair.n_first() : 4); ++k) {
    const VertexId v = pair.vertices[k];
    all.low = std::min(all.low, x.col(v)[axis] - rooms[v]);
    all.high = std::max(all.high, x.col(v)[axis] + rooms[v]);
  }
  return all;
}

/// Rule by which a pair may be left out.
bool stay_apart(const SurfacePair& pair, const Corridors& corridors, double margin) {
  for (int axis = 0; axis < 3; ++axis)
    for (int upper = 0; upper < 2; ++upper) {
      const auto gap = [&](const Positions& x) {
        return interval_of(pair, upper, axis, x, corridors.rooms).low -
               interval_of(pair, 1 - upper, axis, x, corridors.rooms).high;
      };
      if (gap(corridors.begins) >= margin && gap(corridors.ends) >= margin) return true;
    }
  return false;
}

/// All pairs that are looked at, near or not: by definition, not by a list of edges.
std::vector<SurfacePair> all_pairs(const Cloth& cloth) {
  const auto related = [&cloth](VertexId a, VertexId b) {
    return a == b || std::any_of(cloth.hanging.begin(), cloth.hanging.end(), [&](const auto& h) {
             const auto is = [&h](VertexId child, VertexId parent) {
               return h.vertex == child && (h.parents[0] == parent || h.parents[1] == parent);
             };
             return is(a, b) || is(b, a);
           });
  };
  const auto add_if_unrelated = [&](const SurfacePair& pair, std::vector<SurfacePair>& pairs) {
    for (int a = 0; a < pair.n_first(); ++a)
      for (int b = pair.n_first(); b < 4; ++b)
        if (related(pair.vertices[a], pair.vertices[b])) return;
    pairs.push_back(pair);
  };
  const auto is_halved = [&cloth](VertexId a, VertexId b) {
    return std::any_of(cloth.hanging.begin(), cloth.hanging.end(), [&](const auto& h) {
      return (h.parents[0] == a && h.parents[1] == b) || (h.parents[0] == b && h.parents[1] == a);
    });
  };
  std::vector<char> is_used(static_cast<std::size_t>(cloth.n_vertices()), 0);
  std::vector<std::array<VertexId, 2>> edges;
  for (const Triangle& face : cloth.faces)
    for (int k = 0; k < 3; ++k) {
      const VertexId a = face[k];
      const VertexId b = face[(k + 1) % 3];
      is_used[a] = 1;
      if (!is_halved(a, b)) edges.push_back({a, b});
    }
  std::vector<SurfacePair> pairs;
  for (int v = 0; v < cloth.n_vertices(); ++v)
    for (const Triangle& face : cloth.faces)
      if (is_used[v] != 0) add_if_unrelated(vertex_face_pair(VertexId(v), face), pairs);
  for (std::size_t a = 0; a < edges.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) add_if_unrelated(edge_pair(edges[a], edges[b]), pairs);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

bool is_listed(const SurfacePair& pair, const NearPairs& near) {
  return std::binary_search(near.pairs().begin(), near.pairs().end(), pair);
}

std::vector<SurfacePair> list_of(const NearPairs& near) {
  return {near.pairs().begin(), near.pairs().end()};
}

std::vector<SurfacePair> pairs_in(const Cloth& cloth, const Corridors& corridors, double margin) {
  NearPairs near = cloth.near_pairs();
  near.detect(corridors, margin);
  return list_of(near);
}

/// Largest distance from the first place on an axis [m].
double extent(const Corridors& corridors) {
  const Vec3 first = corridors.begins.col(0);
  return std::max((corridors.begins.colwise() - first).cwiseAbs().maxCoeff(),
                  (corridors.ends.colwise() - first).cwiseAbs().maxCoeff());
}

/// Holds a list against the rule, pair by pair.
void check_list(const NearPairs& near, const Cloth& cloth, const Corridors& corridors,
                double margin) {
  const std::vector<SurfacePair> pairs = all_pairs(cloth);
  CHECK(std::adjacent_find(near.pairs().begin(), near.pairs().end(),
                           [](const auto& a, const auto& b) { return !(a < b); }) ==
        near.pairs().end());
  CHECK(std::includes(pairs.begin(), pairs.end(), near.pairs().begin(), near.pairs().end()));
  // Two bounds of a gap, each rounded by 4e-7 of the distance and of rooms and margin.
  const double rounding = 1e-6 * (extent(corridors) + corridors.rooms.maxCoeff() + margin);
  int n_missed = 0;
  int n_far = 0;
  for (const SurfacePair& pair : pairs) {
    const bool listed = is_listed(pair, near);
    n_missed += !listed && !stay_apart(pair, corridors, margin);
    n_far += listed && stay_apart(pair, corridors, margin + rounding);
  }
  CHECK(n_missed == 0);
  CHECK(n_far == 0);
}

}  // namespace

TEST_CASE("near pairs: all are listed that the rule does not leave out, and no others",
          "[contact]") {
  const Family family = GENERATE(from_range(kFamilies));
  const auto seed = static_cast<std::uint64_t>(GENERATE(range(1, 4)));
  CAPTURE(static_cast<int>(family), seed);
  Random random(seed);
  const Cloth cloth = cloth_in(family, random);
  const Corridors corridors = random_corridors(family, cloth, random);
  const double margin = random.uniform(0, 0.1) * kCell;
  NearPairs near = cloth.near_pairs();
  near.detect(corridors, margin);
  check_list(near, cloth, corridors, margin);
  CHECK(near.pairs().size() > 10);
  CHECK(near.pairs().size() < all_pairs(cloth).size());
}

TEST_CASE("near pairs: sides that lack a rounding of being apart are listed", "[contact]") {
  const double shift = GENERATE(0.0, 1e4);
  CAPTURE(shift);
  Cloth cloth = cloth_of(lying_sheet(8));  // cells of 1/8 m, so that all places are exact
  cloth.places.array() += shift;
  Corridors corridors{cloth.places, cloth.places, {}};
  corridors.rooms.setConstant(cloth.n_vertices(), 0.05);
  const double at_limit = 0.125 - 2 * 0.05;
  for (const double share : {1 - 1e-5, 1 + 1e-13}) {
    CAPTURE(share);
    NearPairs near = cloth.near_pairs();
    near.detect(corridors, share * at_limit);
    check_list(near, cloth, corridors, share * at_limit);
    // Edges across a cell.
    CHECK(is_listed(edge_pair({VertexId(0), VertexId(1)}, {VertexId(9), VertexId(10)}), near) ==
          (share > 1));
  }
}

TEST_CASE("near pairs: an unlisted pair keeps its margin whatever way is taken inside of corridors",
          "[contact]") {
  const Family family = GENERATE(Family::folded, Family::crumpled, Family::fast, Family::graded);
  CAPTURE(static_cast<int>(family));
  Random random(7);
  const Cloth cloth = cloth_in(family, random);
  const Corridors corridors = random_corridors(family, cloth, random);
  const double margin = 0.05 * kCell;
  NearPairs near = cloth.near_pairs();
  near.detect(corridors, margin);
  double least = kInfinite;
  const std::vector<SurfacePair> pairs = all_pairs(cloth);
  for (int sample = 0; sample < 30; ++sample) {
    const double t = random.uniform(0, 1);
    Positions x = corridors.begins + t * (corridors.ends - corridors.begins);
    for (int v = 0; v < cloth.n_vertices(); ++v)
      for (int axis = 0; axis < 3; ++axis)
        x(axis, v) += corridors.rooms[v] * (random.below(2) == 0 ? -1 : 1);
    for (const SurfacePair& pair : pairs)
      if (!is_listed(pair, near))
        least = std::min(
            least,
            closest_points(pair_differences(pair, x), pair.n_differences()).difference.norm());
  }
  CHECK(least >= margin * (1 - 1e-9));
  CHECK(least < kCell / 2);
}

TEST_CASE("near pairs: what was found before does not change the list", "[contact]") {
  Random random(5);
  const Cloth cloth = cloth_in(Family::flat, random);
  NearPairs near = cloth.near_pairs();
  for (const Family family : {Family::flat, Family::crumpled, Family::fast, Family::folded}) {
    CAPTURE(static_cast<int>(family));
    const Cloth moved{cloth.faces, cloth_in(family, random).places, {}};
    const Corridors corridors = random_corridors(family, moved, random);
    near.detect(corridors, 0.02);
    CHECK(list_of(near) == pairs_in(cloth, corridors, 0.02));
  }
}

TEST_CASE("near pairs: the tree is kept in motion, and made anew when its boxes have grown",
          "[contact]") {
  Random random(5);
  const Cloth cloth = cloth_in(Family::flat, random);
  Corridors corridors = random_corridors(Family::flat, cloth, random);
  NearPairs near = cloth.near_pairs();
  for (int step = 0; step < 5; ++step) {
    near.detect(corridors, 0.02);
    corridors.begins.colwise() += Vec3(3, -2, 1);
    corridors.ends.colwise() += Vec3(3, -2, 1);
  }
  CHECK(near.n_builds() == 1);
  for (int v = 0; v < cloth.n_vertices(); ++v)  // shuffled
    corridors.begins.col(v).swap(corridors.begins.col(random.below(cloth.n_vertices())));
  corridors.ends = corridors.begins;
  near.detect(corridors, 0.02);
  CHECK(near.n_builds() == 2);
  check_list(near, cloth, corridors, 0.02);
  near.detect(corridors, 0.02);
  CHECK(near.n_builds() == 2);
}

TEST_CASE("near pairs: order and winding of faces do not matter, nor faces that come twice",
          "[contact]") {
  Random random(11);
  const Cloth cloth = cloth_in(Family::graded, random);
  const Corridors corridors = random_corridors(Family::graded, cloth, random);
  Cloth other = cloth;
  for (Triangle& face : other.faces) std::rotate(face.begin(), face.begin() + 1, face.end());
  for (Triangle& face : other.faces) std::swap(face[0], face[1]);
  std::reverse(other.faces.begin(), other.faces.end());
  other.faces.push_back(other.faces.front());
  CHECK(pairs_in(other, corridors, 0.01) == pairs_in(cloth, corridors, 0.01));
}

TEST_CASE("near pairs: edges are each listed once, but for those that are halved", "[contact]") {
  const NearPairs flat = cloth_of(lying_sheet(6)).near_pairs();
  CHECK(flat.edges().size() == 2 * 6 * 7 + 36);
  CHECK(std::is_sorted(flat.edges().begin(), flat.edges().end()));
  const Cloth graded = cloth_of(graded_sheet(2));
  REQUIRE(!graded.hanging.empty());
  const NearPairs near = graded.near_pairs();
  for (const HangingVertex& h : graded.hanging) {
    const auto has = [&near](VertexId a, VertexId b) {
      return std::binary_search(near.edges().begin(), near.edges().end(),
                                std::array{std::min(a, b), std::max(a, b)});
    };
    CHECK(!has(h.parents[0], h.parents[1]));
    CHECK(has(h.parents[0], h.vertex));
    CHECK(has(h.vertex, h.parents[1]));
  }
}

TEST_CASE("near pairs: a lost vertex is in no pair and changes no other", "[contact]") {
  const Family family = GENERATE(Family::crumpled, Family::graded);
  const double lost = GENERATE(as<double>(), kNan, kInfinite, -kInfinite, 1e300, -1e31);
  const int vertex = GENERATE(0, 9);
  const int place = GENERATE(0, 1, 2);
  CAPTURE(static_cast<int>(family), lost, vertex, place);
  Random random(3);
  const Cloth cloth = cloth_in(family, random);
  Corridors corridors = random_corridors(family, cloth, random);
  std::vector<SurfacePair> others = pairs_in(cloth, corridors, 0.01);
  others.erase(std::remove_if(others.begin(), others.end(),
                              [vertex](const SurfacePair& pair) {
                                return std::count(pair.vertices.begin(), pair.vertices.end(),
                                                  VertexId(vertex)) > 0;
                              }),
               others.end());
  if (place == 0) corridors.begins(1, vertex) = lost;
  if (place == 1) corridors.ends(2, vertex) = lost;
  if (place == 2) corridors.rooms[vertex] = std::abs(lost);
  CHECK(pairs_in(cloth, corridors, 0.01) == others);
}

TEST_CASE("near pairs: a cloth whose vertices are all lost has none", "[contact]") {
  const double lost = GENERATE(as<double>(), kNan, kInfinite, 1e300);
  CAPTURE(lost);
  Random random(3);
  const Cloth cloth = cloth_in(Family::flat, random);
  Corridors corridors = random_corridors(Family::flat, cloth, random);
  NearPairs near = cloth.near_pairs();
  const Positions begins = corridors.begins;
  for (const Positions& x : {Positions(Positions::Constant(3, begins.cols(), lost)), begins}) {
    corridors.begins = x;
    near.detect(corridors, 0.01);
    CHECK(near.pairs().empty() == (x(0, 0) != begins(0, 0)));
  }
  CHECK(list_of(near) == pairs_in(cloth, corridors, 0.01));
}

TEST_CASE("near pairs: nothing, one face, and the same place for all", "[contact]") {
  CHECK(pairs_in({{}, Positions::Zero(3, 2), {}},
                 {Positions::Zero(3, 2), Positions::Zero(3, 2), Eigen::VectorXd::Zero(2)}, 0)
            .empty());
  const Cloth one{{{VertexId(0), VertexId(1), VertexId(2)}}, Positions::Zero(3, 3), {}};
  CHECK(pairs_in(one, {one.places, one.places, Eigen::VectorXd::Ones(3)}, 1).empty());
  Cloth point = cloth_of(lying_sheet(3));
  point.places.setZero();
  const Corridors corridors{point.places, point.places, Eigen::VectorXd::Ones(point.n_vertices())};
  CHECK(pairs_in(point, corridors, 0) == all_pairs(point));
}

TEST_CASE("near pairs: faces that are none, sizes and margins are refused", "[contact]") {
  const auto face = [](int a, int b, int c) {
    return std::vector<Triangle>{{VertexId(a), VertexId(b), VertexId(c)}};
  };
  CHECK_THROWS_AS(NearPairs(face(0, 1, 3), {}, 3), ContractError);
  CHECK_THROWS_AS(NearPairs(face(0, -1, 2), {}, 3), ContractError);
  CHECK_THROWS_AS(NearPairs(face(0, 2, 2), {}, 3), ContractError);
  const HangingVertex hanging{VertexId(0), {VertexId(1), VertexId(3)}};
  CHECK_THROWS_AS(NearPairs(face(0, 1, 2), {&hanging, 1}, 3), ContractError);
  NearPairs near(face(0, 1, 2), {}, 3);
  Corridors corridors{Positions::Zero(3, 3), Positions::Zero(3, 3), Eigen::VectorXd::Zero(3)};
  for (const double margin : {-1e-3, kInfinite, kNan})
    CHECK_THROWS_AS(near.detect(corridors, margin), ContractError);
  corridors.rooms.setZero(2);
  CHECK_THROWS_AS(near.detect(corridors, 0), ContractError);
}

TEST_CASE("near pairs: nothing is allocated once most was found, and memory is told", "[contact]") {
  if (!counts_allocations()) return;
  Random random(5);
  const Cloth cloth = cloth_in(Family::flat, random);
  const Cloth crumpled{cloth.faces, cloth_in(Family::crumpled, random).places, {}};
  const Corridors flat_ways = random_corridors(Family::flat, cloth, random);
  const Corridors crumpled_ways = random_corridors(Family::crumpled, crumpled, random);
  NearPairs near = cloth.near_pairs();
  const std::size_t at_first = near.bytes();
  const auto detect_all = [&] {
    near.detect(crumpled_ways, 0.02);
    near.detect(flat_ways, 0.02);
    near.detect(crumpled_ways, 0.01);
  };
  detect_all();
  const std::size_t held = near.bytes();
  CHECK(held > at_first + near.pairs().size() * sizeof(SurfacePair));
  CHECK(allocations_in(detect_all) == 0);
  CHECK(near.bytes() == held);
}

}  // namespace pleat
