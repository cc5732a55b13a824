#include "core/body/garment_patterns.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/check.h"
#include "core/body/body_section.h"
#include "core/mesh/quad_mesh.h"

namespace pleat {
namespace {

using Edge = std::array<int, 2>;

/// How many faces each edge has.
std::map<Edge, int> edge_faces(const QuadPatch& patch) {
  std::map<Edge, int> count;
  for (const auto& quad : patch.quads)
    for (std::size_t k = 0; k < 4; ++k) {
      const int a = quad[k], b = quad[(k + 1) % 4];
      ++count[{std::min(a, b), std::max(a, b)}];
    }
  return count;
}

/// Number of vertices by number of edges, those on the border apart.
struct Valences {
  std::map<int, int> inside, border;
};

Valences valences(const QuadPatch& patch) {
  std::map<int, int> edges;
  std::set<int> border;
  for (const auto& [edge, n_faces] : edge_faces(patch))
    for (const int v : edge) {
      ++edges[v];
      if (n_faces == 1) border.insert(v);
    }
  Valences result;
  for (const auto& [v, n] : edges) ++(border.count(v) ? result.border : result.inside)[n];
  return result;
}

int n_border_loops(const QuadPatch& patch) {
  std::map<int, std::vector<int>> next;
  for (const auto& [edge, n_faces] : edge_faces(patch))
    if (n_faces == 1) {
      next[edge[0]].push_back(edge[1]);
      next[edge[1]].push_back(edge[0]);
    }
  int loops = 0;
  std::set<int> seen;
  for (const auto& [start, ends] : next) {
    if (seen.count(start)) continue;
    ++loops;
    std::vector<int> open = {start};
    while (!open.empty()) {
      const int v = open.back();
      open.pop_back();
      if (seen.insert(v).second) open.insert(open.end(), next[v].begin(), next[v].end());
    }
  }
  return loops;
}

int euler_characteristic(const QuadPatch& patch) {
  return static_cast<int>(patch.rest_positions.cols()) -
         static_cast<int>(edge_faces(patch).size()) + static_cast<int>(patch.quads.size());
}

Vec3 corner(const QuadPatch& patch, std::size_t quad, std::size_t k) {
  return patch.rest_positions.col(patch.quads[quad][k]);
}

/// Mean length along warp over mean length along weft.
double aspect(const QuadPatch& patch, std::size_t quad) {
  const auto side = [&](std::size_t a, std::size_t b) {
    return (corner(patch, quad, a) - corner(patch, quad, b)).norm();
  };
  return (side(0, 1) + side(3, 2)) / (side(0, 3) + side(1, 2));
}

/// The tube a quad is part of is convex round this point, or nearly: the middle of the body, or of
/// a leg below the fork.
Vec3 middle_of_tube(const Vec3& place) {
  const bool in_leg = place.y() < 0.83;
  return {0, place.y(), in_leg ? std::copysign(0.085, place.z()) : 0};
}

const VertexGroup& group_named(const Garment& garment, const std::string& name) {
  return *std::find_if(garment.groups.begin(), garment.groups.end(),
                       [&](const VertexGroup& group) { return group.name == name; });
}

/// Vertices of the second refinement, but for the first row of base quads, that are nearer to some
/// solid than 5 mm and what contact adds for their face (docs/methods/contact.md).
int n_too_near(const Garment& garment, BodyBuild build) {
  const std::vector<BodyPart> body = below_waist(mannequin(build));
  QuadMesh mesh = QuadMesh::from_patch(garment.patch);
  mesh.refine_uniformly(2);
  const int n_waist_quads = static_cast<int>(group_named(garment, "waist").vertices.size());
  int n = 0;
  for (const QuadFace& face : mesh.faces()) {
    if (!face.active() || mesh.faces()[face.parent].parent < n_waist_quads) continue;
    const auto place = [&](int k) { return Vec3(mesh.rest_positions().col(face.corners[k])); };
    const double c = std::max((place(0) - place(2)).norm(), (place(1) - place(3)).norm()) / 2;
    for (const BodyPart& part : body) {
      const double r = std::min(part.shape.radius_a, part.shape.radius_b);
      if (clearance({&part, 1}, place(0)) < 0.005 + std::sqrt(r * r + c * c) - r) ++n;
    }
  }
  return n;
}

Garment skirt_with(double SkirtMeasures::*measure, double value) {
  SkirtMeasures measures;
  measures.*measure = value;
  return skirt(measures, BodyBuild::average);
}

Garment trousers_with(double TrouserMeasures::*measure, double value) {
  TrouserMeasures measures;
  measures.*measure = value;
  return trousers(measures, BodyBuild::average);
}

void check_refused(const std::function<Garment()>& cut, const std::string& where,
                   const std::string& got) {
  CAPTURE(where, got);
  try {
    cut();
    FAIL_CHECK("was accepted");
  } catch (const InputError& error) {
    CHECK(error.where() == where);
    CAPTURE(error.sentence());
    CHECK(error.sentence().find(got) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("garments: a skirt is a tube, trousers are three joined ones", "[figure]") {
  const QuadPatch tube = skirt({}, BodyBuild::average).patch;
  CHECK(euler_characteristic(tube) == 0);
  CHECK(n_border_loops(tube) == 2);
  const QuadPatch three = trousers({}, BodyBuild::average).patch;
  CHECK(euler_characteristic(three) == -1);
  CHECK(n_border_loops(three) == 3);
}

TEST_CASE("garments: only the ends of the line between the legs are irregular", "[figure]") {
  const Valences tube = valences(skirt({}, BodyBuild::average).patch);
  CHECK(tube.inside.size() == 1);
  CHECK(tube.inside.count(4) == 1);
  CHECK(tube.border.size() == 1);
  CHECK(tube.border.count(3) == 1);
  const Valences three = valences(trousers({}, BodyBuild::average).patch);
  CHECK(three.inside.size() == 2);
  CHECK(three.inside.count(4) == 1);
  CHECK(three.inside.at(6) == 2);
  CHECK(three.border.size() == 1);
  CHECK(three.border.count(3) == 1);
}

TEST_CASE("garments: every face is wound outward", "[figure]") {
  const Garment garment =
      GENERATE(0, 1) ? skirt({}, BodyBuild::slim) : trousers({}, BodyBuild::slim);
  const QuadPatch& patch = garment.patch;
  for (std::size_t q = 0; q < patch.quads.size(); ++q) {
    CAPTURE(q);
    const Vec3 middle =
        (corner(patch, q, 0) + corner(patch, q, 1) + corner(patch, q, 2) + corner(patch, q, 3)) / 4;
    const Vec3 normal = (corner(patch, q, 2) - corner(patch, q, 0))
                            .cross(corner(patch, q, 3) - corner(patch, q, 1));
    CHECK(normal.dot(middle - middle_of_tube(middle)) > 0);
  }
}

TEST_CASE("garments: two refinements have the vertices of the published garments", "[figure]") {
  const auto build = GENERATE(BodyBuild::average, BodyBuild::slim);
  QuadMesh tube = QuadMesh::from_patch(skirt({}, build).patch);
  tube.refine_uniformly(2);
  CHECK(tube.n_vertices() > 10200);
  CHECK(tube.n_vertices() < 11500);
  QuadMesh three = QuadMesh::from_patch(trousers({}, build).patch);
  three.refine_uniformly(2);
  CHECK(three.n_vertices() > 9200);
  CHECK(three.n_vertices() < 9700);
}

TEST_CASE("garments: no quad is more than half as long again as wide, nor the reverse",
          "[figure]") {
  const auto build = GENERATE(BodyBuild::average, BodyBuild::slim);
  const Garment garment = GENERATE(0, 1) ? skirt({}, build) : trousers({}, build);
  const QuadPatch& patch = garment.patch;
  for (std::size_t q = 0; q < patch.quads.size(); ++q) {
    CAPTURE(q);
    CHECK(aspect(patch, q) > 1 / 1.5);
    CHECK(aspect(patch, q) < 1.5);
  }
}

TEST_CASE("garments: below the waist's row cloth stays 5 mm off the body", "[figure]") {
  const auto build = GENERATE(BodyBuild::average, BodyBuild::slim);
  CHECK(n_too_near(skirt({}, build), build) == 0);
  CHECK(n_too_near(trousers({}, build), build) == 0);
}

TEST_CASE("garments: the waist lies snugly outside of the body", "[figure]") {
  const auto build = GENERATE(BodyBuild::average, BodyBuild::slim);
  const Garment garment = GENERATE(0, 1) ? skirt({}, build) : trousers({}, build);
  const std::vector<BodyPart> body = below_waist(mannequin(build));
  for (const VertexId v : group_named(garment, "waist").vertices) {
    const Vec3 place = garment.patch.rest_positions.col(v);
    CHECK(place.y() == 0.984);
    CHECK(clearance(body, place) > 0.001);
    CHECK(clearance(body, place) < 0.007);
  }
}

TEST_CASE("garments: hems are where and as wide as they were measured", "[figure]") {
  SkirtMeasures measures;
  measures.columns = 200;  // so many that a polygon is as good as its curve
  const Garment tube = skirt(measures, BodyBuild::average);
  const auto girth_of = [](const Garment& garment, const std::string& name) {
    const std::vector<VertexId>& ring = group_named(garment, name).vertices;
    double girth = 0;
    for (std::size_t i = 0; i < ring.size(); ++i)
      girth += (garment.patch.rest_positions.col(ring[i]) -
                garment.patch.rest_positions.col(ring[(i + 1) % ring.size()]))
                   .norm();
    return girth;
  };
  CHECK(girth_of(tube, "hem") == Approx(measures.hem_girth).epsilon(1e-3));
  const std::vector<BodyPart> body = below_waist(mannequin(BodyBuild::average));
  CHECK(girth_of(tube, "waist") ==
        Approx(girth(outline(body, 0.984, 360)) + measures.waist_ease).epsilon(1e-3));
  // Points at equal distances round make columns run a little askew.
  CHECK(tube.patch.rest_coordinates.row(0).maxCoeff() == Approx(measures.length).epsilon(5e-3));

  const Garment three = trousers({}, BodyBuild::average);
  const double bottom = 0.786 - 0.02 - TrouserMeasures{}.inseam;
  for (const auto& [name, side] : {std::pair("hem_left", -1), std::pair("hem_right", 1)})
    for (const VertexId v : group_named(three, name).vertices) {
      const Vec3 place = three.patch.rest_positions.col(v);
      CHECK(place.y() == Approx(bottom).epsilon(1e-12));
      CHECK((place - Vec3(0, bottom, side * 0.085)).norm() ==
            Approx(TrouserMeasures{}.ankle_opening / (2 * 3.141592653589793)).epsilon(1e-12));
    }
}

TEST_CASE("garments: the left half mirrors the right one", "[figure]") {
  const Garment garment =
      GENERATE(0, 1) ? skirt({}, BodyBuild::average) : trousers({}, BodyBuild::average);
  const Positions& x = garment.patch.rest_positions;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Vec3 mirrored = x.col(i).cwiseProduct(Vec3(1, 1, -1));
    CHECK((x.colwise() - mirrored).colwise().norm().minCoeff() < 1e-7);
  }
}

TEST_CASE("garments: a ring's first coordinate is the mean way down along the threads",
          "[figure]") {
  const Garment garment =
      GENERATE(0, 1) ? skirt({}, BodyBuild::average) : trousers({}, BodyBuild::average);
  const QuadPatch& patch = garment.patch;
  struct Ring {
    double fall = 0;
    double length = 0;
    int n_edges = 0;
  };
  std::map<double, Ring> rings;  // rings by first coordinate
  for (const auto& quad : patch.quads) {
    const double below = patch.rest_coordinates(0, quad[1].value);
    Ring& ring = rings[std::round(below * 1e9)];
    ring.fall = below - patch.rest_coordinates(0, quad[0].value);
    ring.length += (patch.rest_positions.col(quad[1]) - patch.rest_positions.col(quad[0])).norm();
    ++ring.n_edges;
    CHECK(patch.rest_coordinates(0, quad[2].value) == Approx(below).epsilon(1e-9));
  }
  for (const auto& [u, ring] : rings) {
    CAPTURE(u, ring.n_edges);
    CHECK(ring.fall == Approx(ring.length / ring.n_edges).epsilon(1e-9));
  }
}

TEST_CASE("garments: measures that make none are refused by name and value", "[figure]") {
  check_refused([] { return skirt_with(&SkirtMeasures::hem_girth, 0.8); }, "/hem_girth_m",
                "got 0.8");
  check_refused([] { return skirt_with(&SkirtMeasures::hem_girth, 1.1); }, "/hem_girth_m",
                "with 1.1");
  check_refused([] { return skirt_with(&SkirtMeasures::hem_girth, 9); }, "/hem_girth_m", "got 9");
  check_refused([] { return skirt_with(&SkirtMeasures::waist_ease, 0.2); }, "/waist_ease_m",
                "fall over the hips, got 0.2");
  check_refused([] { return skirt_with(&SkirtMeasures::waist_ease, -0.01); }, "/waist_ease_m",
                "got -0.01");
  check_refused([] { return skirt_with(&SkirtMeasures::length, -0.5); }, "/length_m", "got -0.5");
  check_refused([] { return skirt_with(&SkirtMeasures::length, 1.5); }, "/length_m", "got 1.5");
  check_refused([] { return trousers_with(&TrouserMeasures::waist_ease, 0.2); }, "/waist_ease_m",
                "fall over the hips, got 0.2");
  check_refused([] { return trousers_with(&TrouserMeasures::hip_ease, 0.02); }, "/hip_ease_m",
                "with 0.02");
  check_refused([] { return trousers_with(&TrouserMeasures::hip_ease, 0.07); }, "/hip_ease_m",
                "got one at 4.3 mm with 0.07");
  check_refused([] { return trousers_with(&TrouserMeasures::inseam, 0); }, "/inseam_m", "got 0");
  check_refused([] { return trousers_with(&TrouserMeasures::inseam, 0.9); }, "/inseam_m",
                "got 0.9");
  check_refused([] { return trousers_with(&TrouserMeasures::ankle_opening, 0.2); },
                "/ankle_opening_m", "with 0.2");
  check_refused([] { return trousers_with(&TrouserMeasures::ankle_opening, 0.7); },
                "/ankle_opening_m", "got 0.7");
  check_refused([] { return skirt_with(&SkirtMeasures::length, std::nan("")); }, "/length_m",
                "nan");
  SkirtMeasures odd;
  odd.columns = 41;
  CHECK_THROWS_AS(skirt(odd, BodyBuild::average), ContractError);
}

}  // namespace pleat
