#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/files/frame_format.h"
#include "core/mesh/quad_mesh.h"

namespace pleat {

/// The part that all frames of a run share.
struct FrameMesh {
  RestCoordinates rest_coordinates;  ///< 2 x n [m], or empty
  std::vector<Triangle> triangles;   ///< may be empty
};

/// Wavefront OBJ: positions [m] with the fewest digits that read back to the same bits, rest
/// coordinates (along warp, along weft, [m]) as texture coordinates, triangles as faces.
std::string obj_text(const FrameMesh& mesh, const Positions& positions);

/// PLY, binary, little endian: per vertex x y z and, with rest coordinates, s t as doubles;
/// triangles as lists of ints.
std::string ply_bytes(const FrameMesh& mesh, const Positions& positions);

/// More frames of one run are refused: six digits number their files, so that names sort by time.
constexpr int kMaxFrames = 1'000'000;

/// Writes the frames of a run into a folder: frame_000000.obj (or .ply) and so on, or all of them
/// into frames.bin. Same frames, same bytes.
///
/// frames.bin is one line of JSON, {"format": "pleat frames 1", "n_vertices": n}, and then for each
/// frame its time [s] and x y z of each vertex [m], as little-endian 64-bit floats.
class FrameWriter {
 public:
  /// Makes the folder when it is not there. Files of these names in it are replaced, others stay.
  /// Throws FileError naming the folder or file that cannot be written.
  FrameWriter(std::string folder, FrameFormat format, FrameMesh mesh);

  /// The next frames have another mesh. Not for frames.bin, whose frames all have the same
  /// vertices.
  void set_mesh(FrameMesh mesh);

  /// Throws ContractError unless the frame is finite, has as many vertices as those before and
  /// there are at most kMaxFrames, LostOutput when the file cannot take it.
  void write(const Positions& positions, double time);

  /// No frame comes any more. Throws LostOutput when frames.bin cannot be ended.
  void finish();

  int n_frames() const { return n_frames_; }

 private:
  void append_binary(const Positions& positions, double time);

  std::string folder_;
  FrameFormat format_;
  FrameMesh mesh_;
  std::ofstream binary_;
  Eigen::Index n_vertices_ = -1;  // known from the first frame of the mesh on
  int n_frames_ = 0;
};

/// The files in the folder that bear names of frames, sorted; none when there is no such folder.
/// Throws FileError when it cannot be read.
std::vector<std::filesystem::path> frame_files(const std::filesystem::path& folder);

}  // namespace pleat
