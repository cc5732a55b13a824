#include "core/files/frame_file.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "core/base/check.h"
#include "native-tests/support/recorded_frames.h"
#include "native-tests/support/scratch_folder.h"

namespace pleat {
namespace {

/// A place for a folder of frames, which is not there at first.
class FrameFolder {
 public:
  std::string path() const { return (scratch_ / "frames").string(); }
  std::string file(const char* name) const { return path() + "/" + name; }
  std::string bytes(const char* name) const {
    std::ifstream file(path() + "/" + name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

 private:
  ScratchFolder scratch_;
};

FrameMesh triangle_mesh() {
  FrameMesh mesh;
  mesh.rest_coordinates.resize(2, 3);
  mesh.rest_coordinates << 0, 0.5, 0.5, 0, 0, 0.25;
  mesh.triangles = {{VertexId(0), VertexId(1), VertexId(2)}};
  return mesh;
}

Positions triangle_positions() {
  Positions positions(3, 3);
  positions << 0.1, 1.0 / 3, -1, 2, 1e-300, 5, -0.0, 1e22, 0.7;
  return positions;
}

}  // namespace

TEST_CASE("frames: OBJ has positions, rest coordinates and faces counted from one", "[files]") {
  CHECK(obj_text(triangle_mesh(), triangle_positions()) ==
        "v 0.1 2.0 -0.0\nv 0.3333333333333333 1e-300 1e+22\nv -1.0 5.0 0.7\n"
        "vt 0.0 0.0\nvt 0.5 0.0\nvt 0.5 0.25\n"
        "f 1/1 2/2 3/3\n");
}

TEST_CASE("frames: OBJ without rest coordinates has plain faces", "[files]") {
  FrameMesh mesh = triangle_mesh();
  mesh.rest_coordinates.resize(2, 0);
  const std::string text = obj_text(mesh, triangle_positions());
  CHECK(text.find("vt") == std::string::npos);
  CHECK(text.find("f 1 2 3\n") != std::string::npos);
}

TEST_CASE("frames: OBJ positions read back to the bit", "[files]") {
  const Positions positions = triangle_positions();
  std::istringstream lines(obj_text(triangle_mesh(), positions));
  for (Eigen::Index vertex = 0; vertex < positions.cols(); ++vertex) {
    std::string keyword, x, y, z;
    lines >> keyword >> x >> y >> z;
    CHECK(keyword == "v");
    CHECK(std::strtod(x.c_str(), nullptr) == positions(0, vertex));
    CHECK(std::strtod(y.c_str(), nullptr) == positions(1, vertex));
    CHECK(std::strtod(z.c_str(), nullptr) == positions(2, vertex));
  }
}

TEST_CASE("frames: PLY has the bytes that its header announces", "[files]") {
  const Positions positions = triangle_positions();
  const std::string bytes = ply_bytes(triangle_mesh(), positions);
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\nproperty double "
      "y\n"
      "property double z\nproperty double s\nproperty double t\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  REQUIRE(bytes.substr(0, header.size()) == header);
  REQUIRE(bytes.size() == header.size() + 3 * 5 * 8 + 1 + 3 * 4);
  // This test runs on little-endian machines only, the writer does not.
  double x_of_second = 0;
  std::memcpy(&x_of_second, bytes.data() + header.size() + 5 * 8, 8);
  CHECK(x_of_second == positions(0, 1));
  CHECK(bytes.substr(header.size() + 3 * 5 * 8) == std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13));
}

TEST_CASE("frames: binary frames are read back to the bit", "[files]") {
  const FrameFolder folder;
  FrameWriter writer(folder.path(), FrameFormat::binary, triangle_mesh());
  const Positions first = triangle_positions();
  const Positions second = 2 * first;
  writer.write(first, 0);
  writer.write(second, 1.0 / 3);
  CHECK(writer.n_frames() == 2);
  CHECK_FALSE(std::filesystem::exists(folder.file("frames.bin")));  // the last frame is missing
  writer.finish();
  const RecordedFrames recorded = read_frames(folder.file("frames.bin"));
  REQUIRE(recorded.positions.size() == 2);
  CHECK(recorded.times == std::vector<double>{0, 1.0 / 3});
  CHECK(recorded.positions[0] == first);
  CHECK(recorded.positions[1] == second);
}

TEST_CASE("frames: each OBJ and PLY frame is a numbered file", "[files]") {
  const FrameFolder folder;
  const auto format = GENERATE(FrameFormat::obj, FrameFormat::ply);
  const bool is_obj = format == FrameFormat::obj;
  FrameWriter writer(folder.path(), format, triangle_mesh());
  writer.write(triangle_positions(), 0);
  writer.write(2 * triangle_positions(), 1);
  const Positions second = 2 * triangle_positions();
  const std::string expected =
      is_obj ? obj_text(triangle_mesh(), second) : ply_bytes(triangle_mesh(), second);
  CHECK(folder.bytes(is_obj ? "frame_000001.obj" : "frame_000001.ply") == expected);
}

TEST_CASE("frames: the same frames give the same bytes, whatever stood there", "[files]") {
  const FrameFolder folder;
  std::string bytes[2];
  for (std::string& run : bytes) {
    FrameWriter writer(folder.path(), FrameFormat::binary, triangle_mesh());
    writer.write(triangle_positions(), 0);
    if (&run == bytes) writer.write(triangle_positions(), 1);
    writer.finish();
    run = folder.bytes("frames.bin");
  }
  FrameWriter fresh(folder.path() + "/fresh", FrameFormat::binary, triangle_mesh());
  fresh.write(triangle_positions(), 0);
  fresh.finish();
  CHECK(bytes[1] == folder.bytes("fresh/frames.bin"));
}

TEST_CASE("frames: the files of earlier frames are found by their names", "[files]") {
  const FrameFolder folder;
  CHECK(frame_files(folder.path()).empty());
  std::filesystem::create_directory(folder.path());
  for (const char* name : {"frame_000010.obj", "frame_000002.ply", "frames.bin", "frames.bin.part",
                           "frame_12.obj", "frame_000001.png", "frame_000001.obj.part",
                           "myframe_000001.obj", "frame_00000x.obj", "notes.txt"})
    std::ofstream(folder.file(name)) << name;
  std::vector<std::string> names;
  for (const auto& file : frame_files(folder.path())) names.push_back(file.filename().string());
  CHECK(names == std::vector<std::string>{"frame_000002.ply", "frame_000010.obj", "frames.bin",
                                          "frames.bin.part"});
}

TEST_CASE("frames: a folder that cannot be looked into is named", "[files]") {
  const ScratchFolder folder;
  std::filesystem::create_symlink("loop", folder / "loop");
  CHECK_THROWS_AS(frame_files(folder / "loop"), InputError);
  CHECK_THROWS_AS(frame_files(folder / std::string(300, 'x')), InputError);
  CHECK(frame_files("/dev/null/below").empty());
}

TEST_CASE("frames: format none touches no file", "[files]") {
  const FrameFolder folder;
  FrameWriter writer(folder.path(), FrameFormat::none, triangle_mesh());
  writer.write(triangle_positions(), 0);
  CHECK_FALSE(std::filesystem::exists(folder.path()));
}

TEST_CASE("frames: a place that cannot be written to is named", "[files]") {
  const FrameFolder folder;
  std::ofstream(folder.path()) << "a file where the folder should be";
  try {
    const FrameWriter writer(folder.path(), FrameFormat::obj, triangle_mesh());
    FAIL("was accepted");
  } catch (const InputError& error) {
    CHECK(error.where() == folder.path());
  }
}

TEST_CASE("frames: a cut or foreign binary file is refused by name", "[files]") {
  const FrameFolder folder;
  FrameWriter writer(folder.path(), FrameFormat::binary, triangle_mesh());
  writer.write(triangle_positions(), 0);
  writer.finish();
  const std::string whole = folder.bytes("frames.bin");
  const std::size_t n_header = whole.find('\n') + 1;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    if (length == n_header || length == n_header - 1)
      continue;  // a header alone is a run without frames
    CAPTURE(length);
    std::ofstream(folder.file("cut.bin"), std::ios::binary) << whole.substr(0, length);
    try {
      read_frames(folder.file("cut.bin"));
      FAIL_CHECK("was accepted");
    } catch (const InputError& error) {
      CHECK(error.where() == folder.file("cut.bin"));
    }
  }
  CHECK_THROWS_AS(read_frames(folder.file("missing.bin")), InputError);
  CHECK_THROWS_AS(read_frames(folder.path()), InputError);
}

TEST_CASE("frames: a frame that is not finite or of another size is our bug", "[files]") {
  const FrameFolder folder;
  FrameWriter writer(folder.path(), FrameFormat::obj, triangle_mesh());
  Positions positions = triangle_positions();
  positions(1, 1) = std::nan("");
  CHECK_THROWS_AS(writer.write(positions, 0), ContractError);
  CHECK_THROWS_AS(writer.write(Positions::Zero(3, 4), 0), ContractError);
}

TEST_CASE("frames: another mesh may follow in files of their own, not in frames.bin", "[files]") {
  const FrameFolder folder;
  FrameWriter files(folder.path(), FrameFormat::obj, triangle_mesh());
  files.write(triangle_positions(), 0);
  FrameMesh two;
  two.triangles = {{VertexId(0), VertexId(1), VertexId(2)},
                   {VertexId(0), VertexId(2), VertexId(3)}};
  files.set_mesh(two);
  const Positions four = Positions::Identity(3, 4);
  files.write(four, 1);
  CHECK(folder.bytes("frame_000000.obj") == obj_text(triangle_mesh(), triangle_positions()));
  CHECK(folder.bytes("frame_000001.obj") == obj_text(two, four));
  CHECK_THROWS_AS(files.write(triangle_positions(), 2), ContractError);
  FrameWriter binary(folder.path(), FrameFormat::binary, triangle_mesh());
  binary.write(triangle_positions(), 0);
  CHECK_THROWS_AS(binary.set_mesh(two), ContractError);
}

}  // namespace pleat
