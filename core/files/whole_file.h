#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/base/check.h"

namespace pleat {

/// A file or folder that is not as needed; `where` is its path.
class FileError : public InputError {
 public:
  FileError(const std::filesystem::path& path, const std::string& sentence)
      : InputError(path.string(), sentence) {}
};

/// An output that could not be written to its end, as on a full disk. What was asked for was right,
/// so that this is no InputError.
class LostOutput : public std::runtime_error {
 public:
  /// cause  as the system tells it, without a full stop
  LostOutput(const std::filesystem::path& path, const std::string& cause)
      : std::runtime_error(path.string() + ": the output could not be written whole, " + cause) {}
};

/// More bytes are read from no file: about ten times those of the largest mesh that is taken.
constexpr std::size_t kMostBytesOfFile = std::size_t{1} << 30;

/// Reads a file or a pipe. Throws FileError when it cannot be read whole, is larger than
/// kMostBytesOfFile or is a device, which may have no end.
std::string read_file(const std::filesystem::path& path);

/// Writes beside the file first and renames, so that an interrupted run leaves no half of one.
/// Links stay, and the file behind them is written. Throws FileError, also for a device, and
/// LostOutput when what was begun could not be ended.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Throws FileError unless write_file can begin there; everything that stands there stays.
void check_writable(const std::filesystem::path& path);

/// Throws FileError when it still stands there.
void remove_file(const std::filesystem::path& path);

/// Makes the folder and those above it; one that exists keeps what it holds. Throws FileError, and
/// then leaves none that it made.
void make_folder(const std::filesystem::path& path);

}  // namespace pleat
