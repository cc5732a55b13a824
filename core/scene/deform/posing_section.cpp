#include "core/scene/deform/posing_section.h"

#include <cmath>

#include "core/files/motion_file.h"
#include "core/scene/format/bone_word.h"

namespace pleat {
namespace {

constexpr NumberRange kTime{0, 3600};  // [s]

Posing::Moment read_moment(const JsonReader& reader, const FileSource& files) {
  reader.allow_keys({"motion", "time_s"});
  return {read_motion(reader.at("motion"), files), reader.at("time_s").number(kTime)};
}

Vec3 read_facing(const JsonReader& reader) {
  constexpr double kRounding = 1e-9;
  Vec3 facing = reader.direction();
  if (std::abs(facing.y()) > kRounding) reader.fail("a level direction, whose y is 0");
  return facing;
}

}  // namespace

Posing::Posing(const Moment& at_rest, const Moment& posed, Bone pinned, const Vec3& facing)
    : at_rest_(at_rest.motion, {}),
      posed_(posed.motion, {}),
      time_at_rest_(at_rest.time),
      time_posed_(posed.time),
      pinned_(pinned) {
  // The body looks along x, its right is z.
  facing_.rotation << facing, Vec3::UnitY(), facing.cross(Vec3::UnitY());
}

// R and A are how bones have moved from standing into either posture, p is the pinned bone. The
// cloth at bone b belongs to the place R_b^-1 x of the standing body, which the posture takes to
// A_b R_b^-1 x. The whole is then moved as a body, so that p comes back to where it was at rest:
// R_p A_p^-1.
Pose Posing::of(Bone bone) const {
  const auto at_rest = [&](Bone b) { return at_rest_.pose(b, time_at_rest_); };
  const auto posed = [&](Bone b) { return posed_.pose(b, time_posed_); };
  const Pose moved =
      at_rest(pinned_) * posed(pinned_).inverse() * posed(bone) * at_rest(bone).inverse();
  return facing_ * moved * facing_.inverse();
}

Posing read_posing(const JsonReader& reader, const FileSource& files) {
  reader.allow_keys({"at_rest", "posed", "pinned_bone", "facing"});
  return {read_moment(reader.at("at_rest"), files), read_moment(reader.at("posed"), files),
          read_bone(reader.at("pinned_bone")), read_facing(reader.at("facing"))};
}

}  // namespace pleat
