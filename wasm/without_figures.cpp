// What modules without bodies that move have in their place, beside without_garments.cpp.
#include "core/base/check.h"
#include "core/scene/bone_word.h"

namespace pleat {
namespace {

[[noreturn]] void unreachable() { throw ContractError("a scene without a figure asks for one"); }

}  // namespace

Bone read_bone(const JsonReader& reader) {
  throw InputError(reader.pointer(),
                   "expected no bone, as this view shows none; pleat run takes it");
}
const char* bone_name(Bone) { unreachable(); }

MovingBody::MovingBody(const BodyMotion& motion, const Playback&) : curves_(motion.keys) {
  unreachable();
}
std::shared_ptr<const MovingFrame> bone_frame(std::shared_ptr<const MovingBody>, Bone) {
  unreachable();
}
MotionCurves::MotionCurves(const ChannelKeys&) { unreachable(); }

}  // namespace pleat
