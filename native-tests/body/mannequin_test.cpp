#include "core/body/mannequin.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "core/body/body_section.h"
#include "core/files/motion_file.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

using Parts = std::vector<BodyPart>;

/// Parts whose name ends like this.
Parts parts_named(BodyBuild build, const std::string& ending) {
  Parts found;
  for (const BodyPart& part : mannequin(build))
    if (part.name.size() >= ending.size() &&
        part.name.compare(part.name.size() - ending.size(), ending.size(), ending) == 0)
      found.push_back(part);
  return found;
}

Parts without_arms(Parts parts) {
  std::erase_if(parts,
                [](const BodyPart& part) { return part.name.find("arm") != std::string::npos; });
  return parts;
}

double girth_at(const Parts& parts, double height) { return girth(outline(parts, height, 720)); }

/// Distance between two moving solids [m], sampled along the first one's axis and width.
double gap(const BodyPart& a, const BodyPart& b, const MovingBody& body, double time) {
  const Pose to_b = body.pose(b.bone, time).inverse() * body.pose(a.bone, time);
  const RoundedCone& cone = a.shape;
  double least = 1;
  for (const double t : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0})
    for (const double s : {-1.0, 0.0, 1.0}) {
      const double half_width = cone.half_width_a + t * (cone.half_width_b - cone.half_width_a);
      const Vec3 centre =
          cone.centre_a + t * (cone.centre_b - cone.centre_a) + s * half_width * cone.across;
      const double radius = cone.radius_a + t * (cone.radius_b - cone.radius_a);
      least = std::min(least, clearance({&b, 1}, to_b * centre) - radius);
    }
  return least;
}

/// A tape's reading around the trunk, arms lifted, and what was measured on people.
struct TapeReading {
  double height;         // [m]
  double average, slim;  // [m]
};

}  // namespace

TEST_CASE("mannequin: waist, hips and bust have the measured girths within 4 %", "[figure]") {
  const TapeReading tape =
      GENERATE(TapeReading{0.984, 0.857, 0.769}, TapeReading{0.845, 1.016, 0.953},
               TapeReading{1.176, 0.940, 0.874});
  CAPTURE(tape.height);
  CHECK(girth_at(without_arms(mannequin(BodyBuild::average)), tape.height) ==
        Approx(tape.average).epsilon(0.04));
  CHECK(girth_at(without_arms(mannequin(BodyBuild::slim)), tape.height) ==
        Approx(tape.slim).epsilon(0.04));
}

TEST_CASE("mannequin: thigh and calf have the measured girths within 2 %", "[figure]") {
  Parts average, slim;
  for (const char* name : {"thigh_right", "upper_shank_right", "lower_shank_right"}) {
    average.push_back(parts_named(BodyBuild::average, name).at(0));
    slim.push_back(parts_named(BodyBuild::slim, name).at(0));
  }
  CHECK(girth_at(average, 0.786) == Approx(0.612).epsilon(0.02));
  CHECK(girth_at(slim, 0.790) == Approx(0.565).epsilon(0.02));
  CHECK(girth_at(average, 0.358) == Approx(0.373).epsilon(0.02));
  CHECK(girth_at(slim, 0.358) == Approx(0.351).epsilon(0.02));
}

TEST_CASE("mannequin: the standing body fills its height and stands on the floor", "[figure]") {
  const Parts head = parts_named(BodyBuild::average, "head");
  CHECK(clearance(head, {0.01, 1.635, 0}) == Approx(0).margin(1e-9));
  CHECK(clearance(parts_named(BodyBuild::average, "foot_left"), {-0.018, 0, -0.085}) ==
        Approx(0).margin(1e-3));
  for (const BodyPart& part : mannequin(BodyBuild::average)) {
    CAPTURE(part.name);
    CHECK(part.shape.centre_a.y() >= part.shape.radius_a);
    CHECK(part.shape.centre_b.y() >= part.shape.radius_b);
  }
}

TEST_CASE("mannequin: the thighs leave a gap and the crotch its height", "[figure]") {
  const auto build = GENERATE(BodyBuild::average, BodyBuild::slim);
  const double crotch = build == BodyBuild::slim ? 0.790 : 0.786;
  const Parts thighs = [&] {
    Parts both = parts_named(build, "thigh_right");
    both.push_back(parts_named(build, "thigh_left").at(0));
    return both;
  }();
  CHECK(clearance(thighs, {0, crotch, 0}) > 0.007);
  const Parts hips = parts_named(build, "hips");
  CHECK(clearance(hips, {0, crotch, 0}) == Approx(0).margin(1e-9));
}

TEST_CASE("mannequin: every solid is sound and the two sides mirror each other", "[figure]") {
  const auto build = GENERATE(BodyBuild::average, BodyBuild::slim);
  const Vec3 mirror(1, 1, -1);
  const Parts right = parts_named(build, "_right");
  const Parts left = parts_named(build, "_left");
  REQUIRE(right.size() == left.size());
  for (std::size_t i = 0; i < right.size(); ++i) {
    CAPTURE(right[i].name);
    CHECK(left[i].shape.centre_a == right[i].shape.centre_a.cwiseProduct(mirror));
    CHECK(left[i].shape.centre_b == right[i].shape.centre_b.cwiseProduct(mirror));
    CHECK(left[i].shape.radius_a == right[i].shape.radius_a);
    CHECK(left[i].bone != right[i].bone);
  }
  for (const BodyPart& part : mannequin(build)) {
    CAPTURE(part.name);
    const RoundedCone& cone = part.shape;
    CHECK(cone.across.norm() == Approx(1).epsilon(1e-15));
    CHECK(std::abs(cone.across.dot(cone.centre_b - cone.centre_a)) < 1e-15);
    CHECK(cone.radius_a > 0);
    CHECK(cone.radius_b > 0);
    CHECK(cone.half_width_a >= 0);
    CHECK(cone.half_width_b >= 0);
    // Neither end's ball holds the other one.
    const double length = (cone.centre_b - cone.centre_a).norm();
    CHECK((length == 0 || length > std::abs(cone.radius_a - cone.radius_b)));
  }
}

TEST_CASE("mannequin: solids that share a joint overlap however it bends", "[figure]") {
  const auto build = GENERATE(BodyBuild::average, BodyBuild::slim);
  Parts parts = mannequin(build);
  for (const Bone bone : {Bone::thorax, Bone::head, Bone::thigh_left, Bone::shank_left,
                          Bone::foot_left, Bone::upper_arm_left, Bone::forearm_left}) {
    CAPTURE(bone_name(bone));
    Parts of_bone;
    for (const BodyPart& part : parts)
      if (part.bone == bone) of_bone.push_back(part);
    Parts others;
    for (const BodyPart& part : parts)
      if (part.bone != bone) others.push_back(part);
    // The joint is nearer to the one than it is deep in the other; neither changes in a turn.
    CHECK(clearance(of_bone, standing_joint(bone)) + clearance(others, standing_joint(bone)) < 0);
  }
}

TEST_CASE("mannequin: in no motion does one leg run into the other", "[figure]") {
  const std::string name = GENERATE("walk_normal", "walk_fast", "squat", "turn");
  CAPTURE(name);
  const MovingBody body(read_motion(repository_file("assets/motions/" + name + ".json")), {});
  double least = 1;
  for (const BodyPart& right : mannequin(BodyBuild::average))
    for (const BodyPart& left : mannequin(BodyBuild::average))
      if ((right.bone == Bone::thigh_right || right.bone == Bone::shank_right) &&
          (left.bone == Bone::thigh_left || left.bone == Bone::shank_left))
        for (int i = 0; i < 100; ++i) least = std::min(least, gap(right, left, body, i / 40.0));
  CHECK(least > 0.005);
}

}  // namespace pleat
