#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.h"

namespace pleat {

constexpr const char* kOverwriteHelp =
    "  --overwrite            write where a file stands; what is read is never written over\n";

/// What a command may write over: nothing that stands there unless --overwrite says so, and never a
/// file that the command reads.
class Overwriting {
 public:
  /// Takes --overwrite, and spares the file after --fabrics, which has not been taken yet.
  explicit Overwriting(Arguments& arguments);

  bool is_asked() const { return is_asked_; }
  /// Throws InputError when --overwrite was given and nothing is written.
  ///
  /// options  that name outputs, for the sentence
  void need(bool has_output, const char* options) const;

  /// These files are read.
  void spare(const std::vector<std::filesystem::path>& files);
  /// Throws FileError for a file that is read.
  void check_spared(const std::filesystem::path& file) const;
  /// Throws FileError unless write_file may put a file there.
  void check(const std::filesystem::path& file) const;

 private:
  bool is_asked_;
  std::vector<std::filesystem::path> spared_;
};

/// The folder after --out, if there is one, and the frames of another run that stand in it: they
/// are to be removed once there is something to write. Throws before anything is computed where the
/// folder cannot be had or they may not be removed.
///
/// files  that are read, and spared
std::vector<std::filesystem::path> prepare_frame_folder(
    const std::optional<std::string>& folder, Overwriting& overwriting,
    const std::vector<std::filesystem::path>& files);

}  // namespace pleat
