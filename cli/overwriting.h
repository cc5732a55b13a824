#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "core/files/frame_file.h"

namespace pleat {

constexpr const char* kOverwriteHelp =
    "  --overwrite            write where a file stands; what is read is never written over\n";

/// Tells what a command may write over: nothing that stands there unless --overwrite says so, and
/// never a file that the command reads.
class Overwriting {
 public:
  /// Takes --overwrite, and spares the file after --fabrics, which has not been taken yet.
  explicit Overwriting(Arguments& arguments);

  bool is_asked() const { return is_asked_; }
  /// Throws InputError when --overwrite was given and nothing is written; `options` name outputs,
  /// for the sentence.
  void need(bool has_output, const char* options) const;

  /// These files are read.
  void spare(const std::vector<std::filesystem::path>& files) {
    spared_.insert(spared_.end(), files.begin(), files.end());
  }
  /// Throws FileError for a file that is read.
  void check_spared(const std::filesystem::path& file) const;
  /// Throws FileError unless write_file may put a file there.
  void check(const std::filesystem::path& file) const;

 private:
  bool is_asked_;
  std::vector<std::filesystem::path> spared_;
};

/// The folder after --out for frames, which take the place of an earlier run's.
class FrameFolder {
 public:
  /// Takes --out and --overwrite. A run may have a further file there.
  explicit FrameFolder(Arguments& arguments, std::string other = "");

  explicit operator bool() const { return !folder_.empty(); }  ///< --out was given
  Overwriting& overwriting() { return overwriting_; }
  std::filesystem::path other_file() const { return folder_ / other_; }

  /// Makes the folder, where there is to be one. Throws FileError, before anything is computed,
  /// where it cannot be had or its files may not be written over.
  void prepare() const;
  /// Refuses --overwrite without --out, spares the files that are read, and prepares.
  void prepare(const std::vector<std::filesystem::path>& files_read);
  /// Removes the files of an earlier run. Call where there is a folder.
  FrameWriter open(FrameFormat format, const FrameMesh& mesh) const;

 private:
  std::vector<std::filesystem::path> old_files() const;

  std::filesystem::path folder_;
  std::string other_;
  Overwriting overwriting_;
};

}  // namespace pleat
