#pragma once

#include <string>
#include <vector>

#include "core/base/vec.h"

namespace pleat {

struct RecordedFrames {
  std::vector<double> times;  ///< [s]
  std::vector<Positions> positions;
};

/// Reads frames.bin. Throws InputError naming the file when it is not one or was cut.
RecordedFrames read_frames(const std::string& path);

}  // namespace pleat
