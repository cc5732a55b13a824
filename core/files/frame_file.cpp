#include "core/files/frame_file.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <system_error>

#include "core/base/check.h"
#include "core/files/json_text.h"
#include "core/files/obj_file.h"
#include "core/files/whole_file.h"

namespace pleat {
namespace {

constexpr const char* kBinaryName = "frames.bin";
constexpr const char* kBinaryPart = "frames.bin.part";  // name until the last frame is in it
constexpr std::string_view kNumberedName = "frame_";
constexpr std::size_t kDigits = 6;  // digits of a frame's number, enough for kMaxFrames
constexpr const char* kBinaryFormat = "pleat frames 1";

template <class Unsigned>
void append_little_endian(Unsigned bits, std::string& bytes) {
  for (std::size_t k = 0; k < sizeof bits; ++k)
    bytes += static_cast<char>((bits >> (8 * k)) & 0xffU);
}

void append_double(double number, std::string& bytes) {
  std::uint64_t bits = 0;
  static_assert(sizeof bits == sizeof number);
  std::memcpy(&bits, &number, sizeof bits);
  append_little_endian(bits, bytes);
}

std::string frame_path(const std::string& folder, int frame, const char* extension) {
  std::string number = std::to_string(frame);
  number.insert(0, kDigits - number.size(), '0');
  return folder + "/" + std::string(kNumberedName) + number + extension;
}

bool is_frame_name(const std::string& name) {
  if (name == kBinaryName || name == kBinaryPart) return true;
  const std::size_t dot = kNumberedName.size() + kDigits;
  return name.size() == dot + 4 && name.rfind(kNumberedName, 0) == 0 &&
         name.find_first_not_of("0123456789", kNumberedName.size()) == dot &&
         (name.substr(dot) == ".obj" || name.substr(dot) == ".ply");
}

}  // namespace

std::string obj_text(const FrameMesh& mesh, const Positions& positions) {
  std::string text;
  for (Eigen::Index vertex = 0; vertex < positions.cols(); ++vertex)
    text += obj_line("v", {positions.col(vertex).data(), 3});
  for (Eigen::Index vertex = 0; vertex < mesh.rest_coordinates.cols(); ++vertex)
    text += obj_line("vt", {mesh.rest_coordinates.col(vertex).data(), 2});
  const bool has_texture = mesh.rest_coordinates.cols() > 0;
  for (const Triangle& triangle : mesh.triangles) {
    text += 'f';
    for (const VertexId vertex : triangle) {
      const std::string number = std::to_string(vertex.value + 1);
      text.append(" ").append(number);
      if (has_texture) text.append("/").append(number);
    }
    text += '\n';
  }
  return text;
}

std::string ply_bytes(const FrameMesh& mesh, const Positions& positions) {
  const bool has_texture = mesh.rest_coordinates.cols() > 0;
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(positions.cols()) +
                      "\nproperty double x\nproperty double y\nproperty double z\n" +
                      (has_texture ? "property double s\nproperty double t\n" : "") +
                      "element face " + std::to_string(mesh.triangles.size()) +
                      "\nproperty list uchar int vertex_indices\nend_header\n";
  for (Eigen::Index vertex = 0; vertex < positions.cols(); ++vertex) {
    for (const double coordinate : positions.col(vertex)) append_double(coordinate, bytes);
    if (!has_texture) continue;
    for (const double coordinate : mesh.rest_coordinates.col(vertex))
      append_double(coordinate, bytes);
  }
  for (const Triangle& triangle : mesh.triangles) {
    bytes += static_cast<char>(triangle.size());
    for (const VertexId vertex : triangle)
      append_little_endian(static_cast<std::uint32_t>(vertex.value), bytes);
  }
  return bytes;
}

FrameWriter::FrameWriter(std::string folder, FrameFormat format, FrameMesh mesh)
    : folder_(std::move(folder)), format_(format), mesh_(std::move(mesh)) {
  if (format_ == FrameFormat::none) return;
  make_folder(folder_);
}

void FrameWriter::append_binary(const Positions& positions, double time) {
  const std::string path = folder_ + "/" + kBinaryPart;
  std::string bytes;
  if (n_frames_ == 0) {
    binary_.open(path, std::ios::binary | std::ios::trunc);
    const Json header{{"format", kBinaryFormat}, {"n_vertices", positions.cols()}};
    bytes = header.dump() + '\n';
  }
  append_double(time, bytes);
  for (const double coordinate : positions.reshaped()) append_double(coordinate, bytes);
  binary_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  binary_.flush();
  if (!binary_) throw LostOutput(path, "but " + std::to_string(n_frames_) + " frames were");
}

void FrameWriter::set_mesh(FrameMesh mesh) {
  PLEAT_CHECK(format_ != FrameFormat::binary || n_frames_ == 0,
              "all frames of frames.bin have the same vertices");
  mesh_ = std::move(mesh);
  n_vertices_ = -1;
}

void FrameWriter::write(const Positions& positions, double time) {
  PLEAT_CHECK(n_frames_ < kMaxFrames, "a frame's number has six digits");
  if (n_vertices_ < 0) n_vertices_ = positions.cols();
  PLEAT_CHECK(positions.cols() == n_vertices_, "every frame of a mesh has the same vertices");
  PLEAT_CHECK(mesh_.rest_coordinates.cols() == 0 || mesh_.rest_coordinates.cols() == n_vertices_,
              "every vertex has rest coordinates, or none");
  PLEAT_CHECK(positions.allFinite(), "a frame is finite");
  switch (format_) {
    case FrameFormat::none:
      break;
    case FrameFormat::obj:
      write_file(frame_path(folder_, n_frames_, ".obj"), obj_text(mesh_, positions));
      break;
    case FrameFormat::ply:
      write_file(frame_path(folder_, n_frames_, ".ply"), ply_bytes(mesh_, positions));
      break;
    case FrameFormat::binary:
      append_binary(positions, time);
      break;
  }
  ++n_frames_;
}

void FrameWriter::finish() {
  if (!binary_.is_open()) return;
  binary_.close();
  const std::string part = folder_ + "/" + kBinaryPart;
  if (!binary_) throw LostOutput(part, "as it could not be closed");
  std::error_code error;
  std::filesystem::rename(part, folder_ + "/" + kBinaryName, error);
  if (error) throw LostOutput(part, "as it could not be renamed: \"" + error.message() + '"');
}

std::vector<std::filesystem::path> frame_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    if (is_frame_name(entry->path().filename().string())) files.push_back(entry->path());
  if (error && error != std::errc::no_such_file_or_directory && error != std::errc::not_a_directory)
    throw FileError(folder, "expected a folder that can be read, got \"" + error.message() + '"');
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace pleat
