#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/body/mannequin.h"
#include "core/files/file_source.h"
#include "core/files/json_reader.h"

namespace pleat {

/// A body in the scene: a solid, and bones that pins may follow. It stands at time 0.
struct SceneBody {
  BodyBuild build = BodyBuild::average;
  BodyMotion motion;
  Playback playback;
  std::optional<double> friction;  ///< else the fabric's

  std::vector<BodyPart> parts() const;
  /// One body in motion: what follows each Bone, by its number.
  std::vector<std::shared_ptr<const MovingFrame>> bone_frames() const;
};

/// The section "figure" of a scene file: a body, and a motion written out or the name of its file.
std::shared_ptr<const SceneBody> read_body(const JsonReader& reader, const FileSource& files);

/// The motion is always written out, so that the text is the whole scene.
Json json_body(const SceneBody& body);

}  // namespace pleat
