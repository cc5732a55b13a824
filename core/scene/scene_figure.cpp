#include "core/scene/scene_figure.h"

#include "core/files/motion_file.h"

namespace pleat {
namespace {

constexpr std::array<Word<BodyBuild>, 2> kBuilds{
    {{"average", BodyBuild::average}, {"slim", BodyBuild::slim}}};

/// Faster or slower than this no body moves, and a step of 1/60 s would leap over the motion.
constexpr NumberRange kTimeScale{0.05, 20};
constexpr NumberRange kBlendTime{0.05, 1000};  // [s]

}  // namespace

Json json_figure(const Figure& figure) {
  Json json{{"build", word_for(kBuilds, figure.build)},
            {"motion", json_motion(figure.motion)},
            {"time_scale", figure.playback.time_scale},
            {"blend_time_s", figure.playback.blend_time}};
  if (figure.friction) json["friction"] = *figure.friction;
  return json;
}

std::vector<BodyPart> Figure::parts() const { return mannequin(build); }

std::vector<std::shared_ptr<const MovingFrame>> Figure::bone_frames() const {
  const auto body = std::make_shared<const MovingBody>(motion, playback);
  std::vector<std::shared_ptr<const MovingFrame>> frames;
  for (int bone = 0; bone < kBones; ++bone)
    frames.push_back(bone_frame(body, static_cast<Bone>(bone)));
  return frames;
}

std::shared_ptr<const Figure> read_figure(const JsonReader& reader, const FileSource& files) {
  reader.allow_keys({"build", "motion", "time_scale", "blend_time_s", "friction"});
  auto figure = std::make_shared<Figure>();
  if (const auto at = reader.find("build")) figure->build = at->word(kBuilds);
  figure->motion = read_motion(reader.at("motion"), files);
  if (const auto at = reader.find("time_scale"))
    figure->playback.time_scale = at->number(kTimeScale);
  if (const auto at = reader.find("blend_time_s"))
    figure->playback.blend_time = at->number(kBlendTime);
  if (const auto at = reader.find("friction")) figure->friction = at->number(kNotNegative);
  return figure;
}

}  // namespace pleat
