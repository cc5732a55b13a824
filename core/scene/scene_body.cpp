#include "core/scene/scene_body.h"

#include "core/files/motion_file.h"

namespace pleat {
namespace {

constexpr std::array<Word<BodyBuild>, 2> kBuilds{
    {{"average", BodyBuild::average}, {"slim", BodyBuild::slim}}};

/// Faster or slower than this no body moves, and a step of 1/60 s would leap over the motion.
constexpr NumberRange kTimeScale{0.05, 20};
constexpr NumberRange kBlendTime{0.05, 1000};  // [s]

}  // namespace

Json json_body(const SceneBody& body) {
  Json json{{"build", word_for(kBuilds, body.build)},
            {"motion", json_motion(body.motion)},
            {"time_scale", body.playback.time_scale},
            {"blend_time_s", body.playback.blend_time}};
  if (body.friction) json["friction"] = *body.friction;
  return json;
}

std::vector<BodyPart> SceneBody::parts() const { return mannequin(build); }

std::vector<std::shared_ptr<const MovingFrame>> SceneBody::bone_frames() const {
  const auto body = std::make_shared<const MovingBody>(motion, playback);
  std::vector<std::shared_ptr<const MovingFrame>> frames;
  for (int bone = 0; bone < kBones; ++bone)
    frames.push_back(bone_frame(body, static_cast<Bone>(bone)));
  return frames;
}

std::shared_ptr<const SceneBody> read_body(const JsonReader& reader, const FileSource& files) {
  reader.allow_keys({"build", "motion", "time_scale", "blend_time_s", "friction"});
  auto body = std::make_shared<SceneBody>();
  if (const auto at = reader.find("build")) body->build = at->word(kBuilds);
  body->motion = read_motion(reader.at("motion"), files);
  if (const auto at = reader.find("time_scale")) body->playback.time_scale = at->number(kTimeScale);
  if (const auto at = reader.find("blend_time_s"))
    body->playback.blend_time = at->number(kBlendTime);
  if (const auto at = reader.find("friction")) body->friction = at->number(kNotNegative);
  return body;
}

}  // namespace pleat
