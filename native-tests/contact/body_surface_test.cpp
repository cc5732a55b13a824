#include "core/contact/body_surface.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/random.h"
#include "core/contact/body_depth.h"
#include "core/contact/body_start.h"
#include "core/contact/near_pairs.h"
#include "core/contact/surface_crossings.h"
#include "core/mesh/mesh_fault.h"
#include "native-tests/support/bodies.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

const Vec3 kSize(0.7, 0.3, 1.1);  // [m]

Vec3 place_within(double reach, Random& random) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach),
          random.uniform(-reach, reach)};
}

Mat3 turned() { return Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix(); }

}  // namespace

TEST_CASE("body surface: a box is closed, wound outward and holds the product of its sizes",
          "[contact]") {
  const Mat3 turn = turned();
  const BodySurface box = box_body({3, -1, 2}, kSize, turn.col(0), turn.col(1));
  CHECK(box.triangles.size() == 12);
  CHECK_FALSE(mesh_fault(box.places, box.triangles, 0));
  CHECK(enclosed_volume(box.places, box.triangles) == Approx(kSize.prod()).epsilon(1e-14));
  CHECK(own_crossings(box.places, box.triangles).empty());
}

TEST_CASE("signed distance: that of a box is its closed form, on all sides of all edges",
          "[contact]") {
  const Mat3 turn = turned();
  const Vec3 centre(1e3, -2e3, 5e2);
  const BodySurface box = box_body(centre, kSize, turn.col(0), turn.col(1));
  SignedDistance distance(box.places, box.triangles);
  Random random(3);
  for (int k = 0; k < 10000; ++k) {
    Vec3 place = place_within(1, random);
    // Along edges and over corners, too, where several faces are as near.
    if (k % 3 == 1) place[k % 2] = kSize[k % 2];
    if (k % 3 == 2) place = place.cwiseMax(kSize / 2);
    const double exact = height_above_box(kSize, place);
    const double found = distance.at(centre + turn * place);
    REQUIRE(found == Approx(exact).margin(1e-12));
  }
}

TEST_CASE("signed distance: that of a ball's mesh lies between the sphere's and its chords'",
          "[contact]") {
  const BodySurface ball = ball_body(1, 3);
  CHECK(enclosed_volume(ball.places, ball.triangles) == Approx(4 * M_PI / 3).epsilon(0.03));
  SignedDistance distance(ball.places, ball.triangles);
  Random random(5);
  for (int k = 0; k < 3000; ++k) {
    const Vec3 place = place_within(1.5, random);
    const double above = distance.at(place) - (place.norm() - 1);
    REQUIRE(above > -1e-12);
    REQUIRE(above < 0.03);
  }
}

TEST_CASE("signed distance: a spike is outside on both of its sides", "[contact]") {
  // A slab with a needle: the nearest point is its tip, whose plain mean normal would err.
  Positions places(3, 4);
  places << 0, 1, 0, -3, 0, 0, 1, -3, 0, 0, 0, 10;
  std::vector<Triangle> triangles = {{VertexId(0), VertexId(2), VertexId(1)},
                                     {VertexId(0), VertexId(1), VertexId(3)},
                                     {VertexId(1), VertexId(2), VertexId(3)},
                                     {VertexId(2), VertexId(0), VertexId(3)}};
  if (enclosed_volume(places, triangles) < 0)
    for (Triangle& t : triangles) std::swap(t[0], t[1]);
  SignedDistance distance(places, triangles);
  Random random(7);
  for (int k = 0; k < 2000; ++k) {
    Eigen::Vector4d weights(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1),
                            random.uniform(0, 1));
    weights /= weights.sum();
    REQUIRE(distance.at(places * weights) < 0);
    Eigen::Vector4d outer = weights;
    const int k4 = k % 4;
    outer[k4] = -1e-3;
    outer /= outer.sum();
    REQUIRE(distance.at(places * outer) > 0);
  }
}

TEST_CASE("body depth: vertices are told inside of bodies where these are at the time",
          "[contact]") {
  BodySurface box = box_body({0, 0, 0}, kSize, Vec3::UnitX(), Vec3::UnitY());
  box.motion.kind = Motion::Kind::move;
  box.motion.offset = {1, 0, 0};
  box.motion.time_end = 1;
  Positions places(3, 3);
  places << 0, 0.3, 1, 0, 0, 0.1, 0, 0, 0;
  BodyDepth depth(std::span(&box, 1));
  CHECK(depth.at(places, 0).n_inside == 2);
  CHECK(depth.at(places, 0).depth == Approx(0.15));
  CHECK(depth.at(places, 0).deepest == VertexId(0));
  CHECK(depth.at(places, 1).n_inside == 1);
  CHECK(depth.at(places, 1).depth == Approx(0.05));
  CHECK(depth.at(places, 1).deepest == VertexId(2));
}

TEST_CASE("surface crossings: edges that pass a face are found with their place", "[contact]") {
  const QuadMesh sheet = lying_sheet(3);
  const std::vector<Triangle> triangles = sheet.triangles();
  Positions spike(3, 3);
  spike << 0.4, 0.4, 5, 0.45, 0.45, 5, -1, 1, 0;
  const std::vector<Triangle> face = {{VertexId(0), VertexId(1), VertexId(2)}};
  const auto found = crossings(spike, face, sheet.rest_positions(), triangles);
  REQUIRE(found.size() == 1);
  CHECK((found[0].place - Vec3(0.4, 0.45, 0)).norm() < 1e-12);
  CHECK(crossings(spike, face, (sheet.rest_positions().array() + 2).matrix(), triangles).empty());
}

TEST_CASE("surface crossings: a surface that passes through itself is found, not one that bends",
          "[contact]") {
  const BodySurface ball = ball_body(1, 2);
  CHECK(own_crossings(ball.places, ball.triangles).empty());
  Positions through = ball.places;
  through.col(0) = Vec3(-1.5, 0.01, 0.02);  // the foremost vertex, pulled out at the back
  CHECK_FALSE(own_crossings(through, ball.triangles).empty());
}

TEST_CASE("near pairs: groups leave out pairs of bodies, and of loose cloth", "[contact]") {
  const BoxGroup cloth = GENERATE(BoxGroup::cloth, BoxGroup::loose_cloth);
  const QuadMesh sheet = lying_sheet(5);
  const int n = sheet.n_vertices();
  std::vector<Triangle> faces = sheet.triangles();
  Corridors corridors;
  corridors.begins.resize(3, n);
  corridors.begins << sheet.rest_positions();
  std::vector<BoxGroup> groups(static_cast<std::size_t>(n), cloth);
  for (const double x : {0.2, 0.5}) {
    const BodySurface box = box_body({x, 0.5, -0.1}, {0.4, 0.4, 0.3}, Vec3::UnitX(), Vec3::UnitY());
    const auto first = static_cast<int>(groups.size());
    for (const auto& [a, b, c] : box.triangles)
      faces.push_back({VertexId(first + a), VertexId(first + b), VertexId(first + c)});
    corridors.begins.conservativeResize(3, first + 8);
    corridors.begins.rightCols(8) = box.places;
    groups.resize(groups.size() + 8, BoxGroup::body);
  }
  corridors.ends = corridors.begins;
  corridors.ends.row(1).array() += 3;  // a motion of all
  corridors.rooms = Eigen::VectorXd::Constant(corridors.begins.cols(), 0.02);
  NearPairs all(faces, {}, static_cast<int>(groups.size()));
  NearPairs grouped(faces, {}, groups);
  REQUIRE(all.detect(corridors, 0.01));
  REQUIRE(grouped.detect(corridors, 0.01));
  std::vector<SurfacePair> wanted;
  for (const SurfacePair& pair : all.pairs()) {
    const bool first_is_body = pair.vertices[0] >= n;
    const bool second_is_body = pair.vertices[3] >= n;
    if (first_is_body && second_is_body) continue;
    if (cloth == BoxGroup::loose_cloth && !first_is_body && !second_is_body) continue;
    wanted.push_back(pair);
  }
  REQUIRE(wanted.size() > 20);
  CHECK(wanted.size() < all.pairs().size());
  CHECK(std::vector<SurfacePair>(grouped.pairs().begin(), grouped.pairs().end()) == wanted);
}

TEST_CASE("body start: cloth inside, through or on a body is told with its place", "[contact]") {
  const QuadMesh sheet = lying_sheet(2);  // 1 m x 1 m at z = 0
  SelfContact surfaces{sheet.triangles(), {}, sheet.rest_positions()};
  surfaces.body_gap = 1e-3;
  surfaces.is_loose = true;
  const auto told = [&](const Vec3& centre, const Vec3& size) {
    surfaces.bodies = {box_body(centre, size, Vec3::UnitX(), Vec3::UnitY())};
    return cloth_in_bodies(surfaces, sheet.rest_positions(), 0);
  };
  using Catch::Contains;
  CHECK_THAT(told({0.5, 0.5, 0}, {0.2, 0.2, 0.2}),
             Contains("1 vertices inside") && Contains("100 mm at (0.5, 0.5, 0) m"));
  CHECK_THAT(told({0.25, 0.3, 0}, {0.02, 0.02, 0.2}), Contains("crossings"));
  CHECK_THAT(told({0.25, 0.3, -0.1}, {0.02, 0.02, 0.2}), Contains("touches"));
  CHECK_THAT(told({0.25, 0.3, -0.1 - 2e-6}, {0.02, 0.02, 0.2}), Catch::Equals(""));
  CHECK_THAT(told({0.5, 0.5, -2}, {1, 1, 1}), Catch::Equals(""));
}

}  // namespace pleat
