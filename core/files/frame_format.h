#pragma once

namespace pleat {

/// How the frames of a run are written (frame_file.h).
enum class FrameFormat { none, obj, ply, binary };

}  // namespace pleat
