// What modules without bodies that move have in their place, beside without_garments.cpp.
#include "core/base/check.h"
#include "core/scene/bone_word.h"

namespace pleat {
namespace {

[[noreturn]] void no_figure() { throw ContractError("a scene without a figure asks for one"); }

}  // namespace

Bone read_bone(const JsonReader& reader) {
  throw InputError(reader.pointer(),
                   "expected no bone, as this view shows none; pleat run takes it");
}
const char* bone_name(Bone) { no_figure(); }

MovingBody::MovingBody(const BodyMotion& motion, const Playback&) : curves_(motion.keys) {
  no_figure();
}
std::shared_ptr<const MovingFrame> bone_frame(std::shared_ptr<const MovingBody>, Bone) {
  no_figure();
}
MotionCurves::MotionCurves(const ChannelKeys&) { no_figure(); }

}  // namespace pleat
