#pragma once

#include <filesystem>
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

/// Throws FileError when it cannot be read whole.
std::string read_file(const std::filesystem::path& path);

/// Writes beside the file first and renames, so that an interrupted run leaves no half of one.
/// Links stay, and the file behind them is written. Throws FileError, also for a device.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Throws FileError unless write_file can write there; everything that stands there stays.
void check_writable(const std::filesystem::path& path);

/// Throws FileError when it still stands there.
void remove_file(const std::filesystem::path& path);

/// Makes the folder and those above it; one that exists keeps what it holds. Throws FileError, and
/// then leaves none that it made.
void make_folder(const std::filesystem::path& path);

}  // namespace pleat
