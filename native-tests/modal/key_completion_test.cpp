#include "core/modal/key_completion.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "core/base/check.h"
#include "core/base/rigid_motion.h"
#include "native-tests/support/analytic.h"
#include "native-tests/support/bars.h"
#include "native-tests/support/meshes.h"

using namespace pleat;

namespace {

const FineBox& bar() {
  static const FineBox box({1, 0.2, 0.2}, 3);
  return box;
}

ModalOptions few_modes() {
  ModalOptions options;
  options.size = 0.1;
  options.n_modes = 12;
  options.n_functions = 30;
  options.n_clusters = 20;
  return options;
}

Positions moved(const Positions& places, const Mat3& turn, const Vec3& way) {
  return (turn * places).colwise() + way;
}

/// Sum of the volumes of all bodies.
double volume_of(const KeyCompletion& completion, const KeyCompletion::Frame& frame) {
  double volume = 0;
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    const ModalBody& body = completion.bodies()[i];
    volume += total_volume(body.carrying().volume, body.volume_positions(frame.bodies[i]));
  }
  return volume;
}

int inverted_in(const ModalBody& body, const ModalBody::Shape& shape) {
  const Positions positions = body.volume_positions(shape);
  const std::vector<Tet>& tets = body.carrying().volume.tets;
  return static_cast<int>(std::count_if(
      tets.begin(), tets.end(), [&](const Tet& tet) { return tet_volume(positions, tet) <= 0; }));
}

}  // namespace

TEST_CASE("key_completion: between rigid motions all frames are rigid, half way half", "[modal]") {
  const Mat3 turn = Eigen::AngleAxisd(2 * kPi / 3, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const KeyCompletion completion({bar().positions, moved(bar().positions, turn, {2, 0, -1})},
                                 bar().triangles, few_modes());
  const auto frames = completion.frames(5);
  REQUIRE(frames.size() == 5);
  const double whole = bar().positions.cols() > 0 ? completion.bodies()[0].arap().scale() : 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    CAPTURE(f);
    CHECK(frames[f].time == Approx(0.25 * static_cast<double>(f)));
    const Positions surface = completion.surface(frames[f]);
    const RigidMotion motion = nearest_rigid_motion(bar().positions, surface);
    CHECK(farthest(motion.of(bar().positions), surface) < 1e-6);
    CHECK(motion.angle() * 180 / kPi == Approx(30.0 * static_cast<double>(f)).margin(0.01));
    // 1e-8 of a stretch by 1 %.
    CHECK(frames[f].bodies[0].distances.from_a <= 1e-8 * 1e-4 * whole);
  }
}

// Pieces that each took the short way round would go different ways.
TEST_CASE("key_completion: a large turn of all is none of the parts", "[modal]") {
  const double degrees = GENERATE(150.0, 170.0, 179.9, 180.0);
  const double bend = GENERATE(0.0, 1.0);
  CAPTURE(degrees, bend);
  const Mat3 turn =
      Eigen::AngleAxisd(degrees * kPi / 180, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Positions arc = bend > 0 ? bent(bar().positions, bend) : bar().positions;
  const auto middle_of = [&](const Positions& key) {
    const KeyCompletion completion({bar().positions, key}, bar().triangles, few_modes());
    const auto frames = completion.frames(3);
    CHECK(frames[1].unequal_halves() < 0.01);
    return completion.surface(frames[1]);
  };
  const Positions straight = middle_of(arc);
  const Positions turned = middle_of(moved(arc, turn, {0, 0, 0}));
  CHECK(farthest(nearest_rigid_motion(straight, turned).of(straight), turned) < 1e-3);
}

TEST_CASE("key_completion: what stays in both keys stays between them", "[modal]") {
  // A door: turned by 100 degrees about one of its edges.
  const double edge = bar().positions.row(0).minCoeff();
  const Mat3 turn = Eigen::AngleAxisd(100 * kPi / 180, Vec3::UnitZ()).toRotationMatrix();
  const Vec3 hinge(edge, 0, 0);
  const Positions open = moved(bar().positions, turn, hinge - turn * hinge);
  const KeyCompletion completion({bar().positions, open}, bar().triangles, few_modes());
  const Positions half = completion.surface(completion.frames(3)[1]);
  const Mat3 half_turned = Eigen::AngleAxisd(50 * kPi / 180, Vec3::UnitZ()).toRotationMatrix();
  CHECK(farthest(half, moved(bar().positions, half_turned, hinge - half_turned * hinge)) < 0.05);
  // Shifted alone, all is shifted by half.
  const Positions aside = moved(bar().positions, Mat3::Identity(), {1, 2, 3});
  const KeyCompletion shift({bar().positions, aside}, bar().triangles, few_modes());
  CHECK(farthest(shift.surface(shift.frames(3)[1]),
                 moved(bar().positions, Mat3::Identity(), {0.5, 1, 1.5})) < 1e-9);
}

TEST_CASE("key_completion: a bar that bends by 180 degrees keeps its volume", "[modal]") {
  const Positions arc = bent(bar().positions, kPi);
  const KeyCompletion completion({bar().positions, arc}, bar().triangles, few_modes());
  const auto frames = completion.frames(9);
  const double at_rest = volume_of(completion, frames.front());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    CAPTURE(f, volume_of(completion, frames[f]) / at_rest);
    CHECK(volume_of(completion, frames[f]) == Approx(at_rest).epsilon(0.02));
    CHECK(inverted_in(completion.bodies()[0], frames[f].bodies[0]) == 0);
    CHECK(frames[f].unequal_halves() < 0.01);
    CHECK(frames[f].bodies[0].converged);
  }
  // Half way from one vertex to the other it would be pinched.
  const ModalBody& body = completion.bodies()[0];
  const Positions between =
      (body.volume_positions(body.key(0)) + body.volume_positions(body.key(1))) / 2;
  CHECK(total_volume(body.carrying().volume, between) < 0.9 * at_rest);
  // A middle of this one is an arc of 90 degrees.
  const Positions middle = completion.surface(frames[4]);
  const Positions wanted = bent(bar().positions, kPi / 2);
  CHECK(farthest(nearest_rigid_motion(wanted, middle).of(wanted), middle) < 0.03);
}

TEST_CASE("key_completion: keys come back with their detail", "[modal]") {
  Positions dented = bent(bar().positions, 1);
  for (Eigen::Index v = 0; v < dented.cols(); v += 7) dented.col(v) *= 1.01;
  const KeyCompletion completion({bar().positions, dented, bar().positions}, bar().triangles,
                                 few_modes());
  const auto frames = completion.frames(7);
  const std::vector<Positions> keys{bar().positions, dented, bar().positions};
  for (const auto& frame : frames)
    if (frame.is_key())
      CHECK(farthest(completion.surface(frame), keys[static_cast<std::size_t>(frame.left)]) < 1e-9);
  ModalOptions without = few_modes();
  without.detail_beyond = 1;
  const KeyCompletion smooth(keys, bar().triangles, without);
  CHECK(farthest(smooth.surface(smooth.frames(3)[1]), dented) > 1e-3);
}

TEST_CASE("key_completion: from b to a is from a to b backwards", "[modal]") {
  const Positions arc = moved(bent(bar().positions, 2), Mat3::Identity(), {0.5, 0, 0});
  // One reference, to which both runs compare.
  const KeyCompletion there({bar().positions, arc, bar().positions}, bar().triangles, few_modes());
  const auto frames = there.frames(9);
  REQUIRE(frames.size() == 9);
  for (std::size_t f = 1; f < 4; ++f) {
    CAPTURE(f);
    CHECK(frames[f].time == Approx(2 - frames[8 - f].time));
    CHECK(farthest(there.surface(frames[f]), there.surface(frames[8 - f])) < 1e-4);
  }
}

TEST_CASE("key_completion: a key put elsewhere is met, without other modes", "[modal]") {
  KeyCompletion completion({bar().positions, bent(bar().positions, 2)}, bar().triangles,
                           few_modes());
  const Positions other = bent(bar().positions, 1.5);
  CHECK(completion.replace_key(1, other).ok());
  const auto frames = completion.frames(3);
  CHECK(farthest(completion.surface(frames[2]), other) < 1e-9);
  CHECK(farthest(completion.surface(frames[0]), bar().positions) < 1e-9);
}

TEST_CASE("key_completion: parts that do not touch move each for itself", "[modal]") {
  const Eigen::Index n = bar().positions.cols();
  const auto two = [&](const Positions& first, const Positions& second) {
    Positions both(3, 2 * n);
    both << first, second;
    return both;
  };
  std::vector<Triangle> triangles = bar().triangles;
  for (const auto& [a, b, c] : bar().triangles)
    triangles.push_back({VertexId(static_cast<int>(n) + a), VertexId(static_cast<int>(n) + b),
                         VertexId(static_cast<int>(n) + c)});
  const Mat3 turn = Eigen::AngleAxisd(kPi / 2, Vec3::UnitY()).toRotationMatrix();
  const Positions aside = moved(bar().positions, Mat3::Identity(), {0, 1, 0});
  const KeyCompletion completion(
      {two(bar().positions, aside),
       two(bent(bar().positions, 1), moved(bar().positions, turn, {0, 2, 0}))},
      triangles, few_modes());
  REQUIRE(completion.bodies().size() == 2);
  const Positions middle = completion.surface(completion.frames(3)[1]);
  const Positions second = middle.rightCols(n);
  const RigidMotion motion = nearest_rigid_motion(bar().positions, second);
  CHECK(farthest(motion.of(bar().positions), second) < 1e-6);
  CHECK(motion.angle() == Approx(kPi / 4));
  CHECK(second.row(1).mean() == Approx(1.5));
}

TEST_CASE("key_completion: an open sheet is carried by a shell", "[modal]") {
  const TriangleMesh sheet = triangulated_sheet(Triangulation::alternating, 8, 8, 0.1);
  ModalOptions options = few_modes();
  options.size = 0;
  const Positions rolled = bent(sheet.rest_positions, 2);
  const KeyCompletion completion({sheet.rest_positions, rolled}, sheet.triangles, options);
  const auto frames = completion.frames(5);
  CHECK(farthest(completion.surface(frames.back()), rolled) < 1e-9);
  CHECK(frames[2].unequal_halves() < 0.01);
}

TEST_CASE("key_completion: frames come as near to each other as is asked", "[modal]") {
  const KeyCompletion completion({bar().positions, bent(bar().positions, 1)}, bar().triangles,
                                 few_modes());
  const auto frames = completion.frames_by_step(0.03, 100);
  CHECK(frames.size() < 100);
  for (std::size_t f = 1; f < frames.size(); ++f)
    CHECK(farthest(completion.surface(frames[f - 1]), completion.surface(frames[f])) <= 0.03);
  CHECK(completion.frames_by_step(0.001, 6).size() == 6);
}

TEST_CASE("key_completion: what cannot be filled in is a sentence", "[modal]") {
  using Catch::Matchers::Contains;
  const auto complete = [](const std::vector<Positions>& keys,
                           const std::vector<Triangle>& triangles, ModalOptions options) {
    return KeyCompletion(keys, triangles, options).n_keys();
  };
  const Positions& straight = bar().positions;
  CHECK_THROWS_WITH(complete({straight}, bar().triangles, few_modes()), Contains("two keys"));
  CHECK_THROWS_WITH(
      complete({straight, straight.leftCols(straight.cols() - 1)}, bar().triangles, few_modes()),
      Contains("the same vertices"));
  Positions nowhere = straight;
  nowhere(1, 5) = std::nan("");
  CHECK_THROWS_WITH(complete({straight, nowhere}, bar().triangles, few_modes()),
                    Contains("finite"));
  CHECK_THROWS_WITH(complete({straight, straight}, {}, few_modes()), Contains("triangle"));
  ModalOptions too_many = few_modes();
  too_many.n_modes = 100000;
  CHECK_THROWS_WITH(complete({straight, straight}, bar().triangles, too_many), Contains("modes"));
  Positions pressed = straight;
  pressed.row(2).setZero();
  ModalOptions usual = few_modes();
  usual.size = 0;
  CHECK_THROWS_WITH(complete({pressed, pressed}, bar().triangles, usual),
                    Contains("encloses a volume"));
  ModalOptions lattice = few_modes();
  lattice.volume = VolumeKind::lattice;
  const TriangleMesh sheet = triangulated_sheet(Triangulation::alternating, 4, 4, 0.1);
  CHECK_THROWS_WITH(
      complete({sheet.rest_positions, sheet.rest_positions}, sheet.triangles, lattice),
      Contains("closed"));
}
