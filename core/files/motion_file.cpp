#include "core/files/motion_file.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/base/check.h"

namespace pleat {
namespace {

/// The keys of the file in the order of MotionChannel.
constexpr std::array<const char*, kMotionChannels> kKeys = {"pelvis_tilt_rad",
                                                            "pelvis_obliquity_rad",
                                                            "pelvis_rotation_rad",
                                                            "hip_flexion_rad",
                                                            "hip_adduction_rad",
                                                            "hip_rotation_rad",
                                                            "knee_flexion_rad",
                                                            "ankle_dorsiflexion_rad",
                                                            "thorax_tilt_rad",
                                                            "thorax_obliquity_rad",
                                                            "thorax_rotation_rad",
                                                            "shoulder_flexion_rad",
                                                            "shoulder_abduction_rad",
                                                            "elbow_flexion_rad",
                                                            "head_rotation_rad",
                                                            "height_m",
                                                            "ahead_m",
                                                            "right_m"};

constexpr double kHalfTurn = 3.141592653589793;  // [rad]; most angles in degrees are beyond it
constexpr NumberRange kAngle{-kHalfTurn, kHalfTurn};
constexpr NumberRange kPath{-10, 10};          // [m]
constexpr NumberRange kCycleTime{0.01, 1000};  // [s]
constexpr NumberRange kSpeed{-100, 100};       // [m/s]
constexpr NumberRange kPhase{0, 1};

/// All keys of a channel, or the one value that stays.
std::vector<double> read_channel(const JsonReader& reader, const NumberRange& range) {
  if (!reader.is_array()) return {reader.number(range)};
  std::vector<double> keys;
  for (const JsonReader& key : reader.elements()) keys.push_back(key.number(range));
  if (keys.size() < kFewestKeys) reader.fail("at least " + std::to_string(kFewestKeys) + " keys");
  return keys;
}

ChannelKeys read_channels(const JsonReader& angles, const JsonReader& path) {
  const std::span<const char* const> keys(kKeys);
  angles.allow_keys(keys.first(kAngleChannels));
  path.allow_keys(keys.subspan(kAngleChannels));
  std::array<std::vector<double>, kMotionChannels> channels;
  std::size_t n_keys = 0;  // keys of the first channel that has several
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const bool is_angle = c < kAngleChannels;
    const JsonReader reader = (is_angle ? angles : path).at(kKeys[c]);
    channels[c] = read_channel(reader, is_angle ? kAngle : kPath);
    if (channels[c].size() == 1) continue;
    if (n_keys == 0) n_keys = channels[c].size();
    if (channels[c].size() != n_keys)
      reader.fail(std::to_string(n_keys) + " keys, as the channels before it have");
  }
  ChannelKeys result(kMotionChannels, std::max<std::size_t>(n_keys, kFewestKeys));
  for (std::size_t c = 0; c < channels.size(); ++c)
    for (Eigen::Index k = 0; k < result.cols(); ++k)
      result(static_cast<Eigen::Index>(c), k) =
          channels[c].size() == 1 ? channels[c][0] : channels[c][static_cast<std::size_t>(k)];
  return result;
}

Json json_channel(const ChannelKeys& keys, int channel) {
  const auto row = keys.row(channel);
  if ((row.array() == row[0]).all()) return row[0];
  Json json = Json::array();
  for (const double key : row) json.push_back(key);
  return json;
}

}  // namespace

BodyMotion read_motion(const JsonReader& reader) {
  reader.allow_keys({"name", "confidence", "sources", "cycle_time_s", "forward_speed_m_per_s",
                     "left_phase_cycles", "angles", "pelvis_path"});
  BodyMotion motion;
  motion.name = reader.at("name").text();
  if (const auto at = reader.find("confidence")) at->text();
  if (const auto at = reader.find("sources"))
    for (const auto& [key, citation] : at->members()) citation.text();
  motion.cycle_time = reader.at("cycle_time_s").number(kCycleTime);
  motion.forward_speed = reader.at("forward_speed_m_per_s").number(kSpeed);
  motion.left_phase = reader.at("left_phase_cycles").number(kPhase);
  motion.keys = read_channels(reader.at("angles"), reader.at("pelvis_path"));
  return motion;
}

BodyMotion read_motion(std::string_view json_text) {
  const Json document = parse_json(json_text);
  return read_motion(JsonReader(document));
}

BodyMotion read_motion(const JsonReader& reader, const FileSource& files) {
  if (!reader.is_text()) return read_motion(reader);
  if (!files) reader.fail("a motion written out, as no files can be read here");
  return read_named_file(reader, files, [](const std::string& text) { return read_motion(text); });
}

Json json_motion(const BodyMotion& motion) {
  Json angles;
  Json path;
  for (int c = 0; c < kMotionChannels; ++c)
    (c < kAngleChannels ? angles : path)[kKeys[static_cast<std::size_t>(c)]] =
        json_channel(motion.keys, c);
  return {{"name", motion.name},
          {"cycle_time_s", motion.cycle_time},
          {"forward_speed_m_per_s", motion.forward_speed},
          {"left_phase_cycles", motion.left_phase},
          {"angles", angles},
          {"pelvis_path", path}};
}

}  // namespace pleat
