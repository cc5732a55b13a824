#include "native-tests/support/recorded_frames.h"

#include <cstdint>
#include <cstring>
#include <string_view>

#include "core/base/check.h"
#include "core/files/json_reader.h"
#include "core/files/whole_file.h"

namespace pleat {
namespace {

constexpr const char* kBinaryFormat = "pleat frames 1";
constexpr std::size_t kDoubleSize = 8;  // bytes

double double_at(std::string_view bytes, std::size_t offset) {
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < kDoubleSize; ++k)
    bits |= std::uint64_t{static_cast<unsigned char>(bytes[offset + k])} << (8 * k);
  double number = 0;
  std::memcpy(&number, &bits, sizeof number);
  return number;
}

/// The header line, or an error that says it is missing.
std::size_t read_n_vertices(const std::string& path, std::string_view line) {
  try {
    const Json document = parse_json(line);
    const JsonReader header(document);
    header.allow_keys({"format", "n_vertices"});
    if (header.at("format").text() != kBinaryFormat) header.at("format").fail(kBinaryFormat);
    return static_cast<std::size_t>(header.at("n_vertices").integer(0, 1000000000));
  } catch (const InputError& error) {
    throw InputError(path, "expected frames that this program wrote, got a header in which " +
                               error.where() + ": " + error.sentence());
  }
}

}  // namespace

RecordedFrames read_frames(const std::string& path) {
  const std::string file = read_file(path);
  const std::size_t line_end = file.find('\n');
  const std::size_t n_vertices = read_n_vertices(path, std::string_view(file).substr(0, line_end));
  const std::string_view body =
      std::string_view(file).substr(line_end == std::string::npos ? file.size() : line_end + 1);
  const std::size_t frame_size = kDoubleSize * (1 + 3 * n_vertices);
  if (body.size() % frame_size != 0)
    throw InputError(path, "expected frames of " + std::to_string(frame_size) + " bytes, got " +
                               std::to_string(body.size() % frame_size) +
                               " bytes of one that was cut");
  RecordedFrames recorded;
  for (std::size_t begin = 0; begin < body.size(); begin += frame_size) {
    recorded.times.push_back(double_at(body, begin));
    Positions positions(3, static_cast<Eigen::Index>(n_vertices));
    std::size_t offset = begin;
    for (double& coordinate : positions.reshaped())
      coordinate = double_at(body, offset += kDoubleSize);
    recorded.positions.push_back(std::move(positions));
  }
  return recorded;
}

}  // namespace pleat
