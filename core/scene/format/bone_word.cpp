#include "core/scene/format/bone_word.h"

#include <string>

namespace pleat {

Bone read_bone(const JsonReader& reader) {
  std::string known;
  for (int b = 0; b < kBones; ++b) {
    const Bone bone = static_cast<Bone>(b);
    if (reader.is_text() && reader.text() == bone_name(bone)) return bone;
    known += std::string(b == 0 ? " \"" : ", \"") + bone_name(bone) + '"';
  }
  reader.fail("one of" + known);
}

}  // namespace pleat
