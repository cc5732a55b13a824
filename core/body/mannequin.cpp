#include "core/body/mannequin.h"

#include <algorithm>

namespace pleat {
namespace {

/// Radius and half width of a section [m].
struct Section {
  double radius;
  double half_width;
};

/// Sections of the torso are wide across the body, those of the thigh from front to back.
struct Measures {
  double crotch_height;  // [m]
  Section hips, waist, chest, shoulders;
  Section thigh;  // section at the crotch
  double knee, calf_top, calf, ankle;
  double shoulder, elbow, elbow_below, wrist;
  double neck;
};

/// A thigh of the measured girth that is round would run into the other one. Its radius leaves the
/// thighs 16 mm (slim: 24 mm) apart at the crotch, its width makes up the girth.
constexpr Measures kAverage{0.786,          {0.116, 0.060}, {0.105, 0.044}, {0.122, 0.012},
                            {0.055, 0.130}, {0.077, 0.032}, 0.064,          0.059,
                            0.059,          0.034,          0.048,          0.041,
                            0.042,          0.025,          0.052};
constexpr Measures kSlim{0.790,          {0.105, 0.061}, {0.092, 0.044}, {0.112, 0.017},
                         {0.050, 0.130}, {0.073, 0.027}, 0.059,          0.055,
                         0.056,          0.033,          0.044,          0.037,
                         0.040,          0.024,          0.050};

constexpr double kWaistJointHeight = 0.984;  // [m], as the three below
constexpr double kChestHeight = 1.176;
constexpr double kShoulderHeight = 1.305;
constexpr double kTorsoX = -0.01;  // x [m] of waist, chest and shoulders; hips and thighs are at 0

constexpr double kCalfShare = 0.27;  // share of the shank, from the knee down, where it is thickest

Vec3 on_side(double side, const Vec3& right) { return {right.x(), right.y(), side * right.z()}; }

/// The end of a cone at joint_a such that its section at `share` of the way to joint_b is `at`.
Section extrapolated(const Section& at, const Section& end_b, double share) {
  return {(at.radius - share * end_b.radius) / (1 - share),
          (at.half_width - share * end_b.half_width) / (1 - share)};
}

RoundedCone cone(const Vec3& a, const Section& section_a, const Vec3& b, const Section& section_b,
                 const Vec3& across) {
  return {
      a, b, section_a.radius, section_b.radius, across, section_a.half_width, section_b.half_width};
}

RoundedCone round_cone(const Vec3& a, double radius_a, const Vec3& b, double radius_b) {
  return cone(a, {radius_a, 0}, b, {radius_b, 0}, (b - a).unitOrthogonal());
}

void add_torso(const Measures& m, std::vector<BodyPart>& parts) {
  const Vec3 across(0, 0, 1);
  // Measured hips stand lower, but their ball would then fill the crotch; the thighs make up what
  // is missing of their girth.
  const Vec3 hips(0, m.crotch_height + m.hips.radius, 0);
  const Vec3 waist(kTorsoX, kWaistJointHeight, 0);
  const Vec3 chest(kTorsoX, kChestHeight, 0);
  const Vec3 shoulders(kTorsoX, kShoulderHeight, 0);
  parts.push_back({"hips", cone(hips, m.hips, waist, m.waist, across), Bone::pelvis});
  parts.push_back({"waist", cone(waist, m.waist, chest, m.chest, across), Bone::thorax});
  parts.push_back({"chest", cone(chest, m.chest, shoulders, m.shoulders, across), Bone::thorax});
  // The chest's section is an eighth below the girth of the bust; breasts of 0.075 m, sloping up to
  // the collarbone, make up for it.
  constexpr Section kBreasts{0.075, 0.065};
  constexpr Section kCollar{0.05, 0.09};
  parts.push_back(
      {"bust", cone(Vec3(0.06, kChestHeight, 0), kBreasts, Vec3(0.015, 1.29, 0), kCollar, across),
       Bone::thorax});
}

void add_head(const Measures& m, std::vector<BodyPart>& parts) {
  const Vec3 centre(0.01, 1.525, 0);
  parts.push_back(
      {"neck", round_cone(standing_joint(Bone::head), m.neck, centre, m.neck), Bone::head});
  // A box of 0.19 m x 0.22 m x 0.148 m touches it on all sides.
  constexpr Section kHead{0.074, 0.021};
  const Vec3 up(0, 0.036, 0);
  parts.push_back(
      {"head", cone(centre - up, kHead, centre + up, kHead, Vec3(1, 0, 0)), Bone::head});
}

struct LegBones {
  const char* side_name;
  double side;
  Bone thigh, shank, foot;
};

void add_leg(const Measures& m, const LegBones& leg, std::vector<BodyPart>& parts) {
  const Vec3 hip = standing_joint(leg.thigh);
  const Vec3 knee = standing_joint(leg.shank);
  const Vec3 ankle = standing_joint(leg.foot);
  const Vec3 calf = knee + kCalfShare * (ankle - knee);
  const Section knee_section{m.knee, 0};
  const Section hip_section =
      extrapolated(m.thigh, knee_section, (hip.y() - m.crotch_height) / (hip.y() - knee.y()));
  const std::string name = leg.side_name;
  parts.push_back(
      {"thigh_" + name, cone(hip, hip_section, knee, knee_section, Vec3(1, 0, 0)), leg.thigh});
  parts.push_back({"upper_shank_" + name, round_cone(knee, m.calf_top, calf, m.calf), leg.shank});
  parts.push_back({"lower_shank_" + name, round_cone(calf, m.calf, ankle, m.ankle), leg.shank});
  // The foot from the heel to where the toes begin, 0.18 m, standing on the floor.
  constexpr Section kHeel{0.032, 0};
  constexpr Section kBall{0.022, 0.022};
  const Vec3 heel = on_side(leg.side, {-0.018, kHeel.radius, 0.085});
  const Vec3 ball = on_side(leg.side, {0.13, kBall.radius, 0.09});
  const Vec3 across = (ball - heel).cross(Vec3(0, 1, 0)).normalized();
  parts.push_back({"foot_" + name, cone(heel, kHeel, ball, kBall, across), leg.foot});
}

struct ArmBones {
  const char* side_name;
  double side;
  Bone upper_arm, forearm;
};

void add_arm(const Measures& m, const ArmBones& arm, std::vector<BodyPart>& parts) {
  const Vec3 elbow = standing_joint(arm.forearm);
  const Vec3 wrist = on_side(arm.side, {kTorsoX, 0.79, 0.18});
  const std::string name = arm.side_name;
  parts.push_back({"upper_arm_" + name,
                   round_cone(standing_joint(arm.upper_arm), m.shoulder, elbow, m.elbow),
                   arm.upper_arm});
  parts.push_back(
      {"forearm_" + name, round_cone(elbow, m.elbow_below, wrist, m.wrist), arm.forearm});
}

}  // namespace

std::vector<BodyPart> mannequin(BodyBuild build) {
  const Measures& m = build == BodyBuild::slim ? kSlim : kAverage;
  std::vector<BodyPart> parts;
  add_torso(m, parts);
  add_head(m, parts);
  add_leg(m, {"right", 1, Bone::thigh_right, Bone::shank_right, Bone::foot_right}, parts);
  add_leg(m, {"left", -1, Bone::thigh_left, Bone::shank_left, Bone::foot_left}, parts);
  add_arm(m, {"right", 1, Bone::upper_arm_right, Bone::forearm_right}, parts);
  add_arm(m, {"left", -1, Bone::upper_arm_left, Bone::forearm_left}, parts);
  return parts;
}

std::vector<BodyPart> below_waist(std::vector<BodyPart> parts) {
  const auto above = std::remove_if(
      parts.begin(), parts.end(), [](const BodyPart& part) { return !is_below_waist(part.bone); });
  parts.erase(above, parts.end());
  return parts;
}

}  // namespace pleat
