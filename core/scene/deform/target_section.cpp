#include "core/scene/deform/target_section.h"

#include <cmath>

#include "core/base/check.h"
#include "core/scene/format/bone_word.h"

namespace pleat {
namespace {

/// Targets straight above or below, on the upper half of a ball.
Positions onto_sphere(const JsonReader& reader, const Positions& from) {
  reader.allow_keys({"centre_m", "radius_m"});
  const Vec3 centre = reader.at("centre_m").vec3();
  const double radius = reader.at("radius_m").number(kPositive);
  Positions targets = from;
  for (auto x : targets.colwise()) {
    const double beside = std::hypot(x.x() - centre.x(), x.z() - centre.z());
    if (beside > radius)
      throw InputError(reader.pointer(),
                       "expected a ball below or above all of the handle's vertices, got one that "
                       "lies " +
                           Json(beside).dump() + " m beside its centre");
    x.y() = centre.y() + std::sqrt(radius * radius - beside * beside);
  }
  return targets;
}

Positions turned(const JsonReader& reader, const Positions& from) {
  reader.allow_keys({"axis", "angle_deg", "centre_m"});
  const double angle = reader.at("angle_deg").number() * M_PI / 180;
  const Eigen::AngleAxisd turn(angle, reader.at("axis").direction());
  Vec3 centre = from.rowwise().mean();
  if (const auto at = reader.find("centre_m")) centre = at->vec3();
  return (turn.toRotationMatrix() * (from.colwise() - centre)).colwise() + centre;
}

}  // namespace

Positions read_targets(const JsonReader& reader, const Posing* posing, const Positions& from) {
  if (const auto at = reader.find("onto_sphere")) {
    reader.only_one_of({"onto_sphere", "move_m", "turn", "bone"});
    return onto_sphere(*at, from);
  }
  if (const auto at = reader.find("bone")) {
    reader.only_one_of({"bone", "move_m", "turn"});
    if (posing == nullptr) at->fail("no bone without a figure");
    const Pose pose = posing->of(read_bone(*at));
    return (pose.rotation * from).colwise() + pose.translation;
  }
  const auto turn = reader.find("turn");
  const auto move = reader.find("move_m");
  if (!turn && !move) reader.only_one_of({"move_m", "onto_sphere", "turn", "bone"});
  Positions targets = turn ? turned(*turn, from) : from;
  if (move) targets.colwise() += move->vec3();
  return targets;
}

}  // namespace pleat
