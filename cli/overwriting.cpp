#include "cli/overwriting.h"

#include "core/files/whole_file.h"

namespace pleat {

Overwriting::Overwriting(Arguments& arguments) : is_asked_(arguments.flag("--overwrite")) {
  if (const auto fabrics = Arguments(arguments).text("--fabrics")) spare({*fabrics});
}

void Overwriting::need(bool has_output, const char* options) const {
  if (is_asked_ && !has_output)
    throw InputError("--overwrite", std::string("expected ") + options + " beside it, got none");
}

void Overwriting::check_spared(const std::filesystem::path& file) const {
  std::error_code error;  // a file may not be there
  for (const std::filesystem::path& spared : spared_)
    if (std::filesystem::equivalent(file, spared, error))
      throw FileError(file, "expected another file than those that are read, got one of them");
}

void Overwriting::check(const std::filesystem::path& file) const {
  check_writable(file);
  check_spared(file);
  std::error_code error;
  if (!is_asked_ && std::filesystem::exists(file, error))
    throw FileError(file,
                    "expected a name that no file has, got one that has; --overwrite "
                    "replaces it");
}

FrameFolder::FrameFolder(Arguments& arguments, std::string other)
    : folder_(arguments.text("--out").value_or("")),
      other_(std::move(other)),
      overwriting_(arguments) {}

std::vector<std::filesystem::path> FrameFolder::old_files() const {
  std::vector<std::filesystem::path> files = frame_files(folder_);
  std::error_code error;
  if (!other_.empty() && std::filesystem::exists(other_file(), error))
    files.push_back(other_file());
  return files;
}

void FrameFolder::prepare() const {
  if (folder_.empty()) return;
  const std::vector<std::filesystem::path> old = old_files();
  if (!old.empty() && !overwriting_.is_asked())
    throw FileError(folder_, "expected a folder without a run's files, got " +
                                 old.front().filename().string() + "; --overwrite removes them");
  make_folder(folder_);
  if (!other_.empty()) check_writable(other_file());
  for (const std::filesystem::path& file : old) overwriting_.check(file);
}

void FrameFolder::prepare(const std::vector<std::filesystem::path>& files_read) {
  overwriting_.need(!folder_.empty(), "--out");
  overwriting_.spare(files_read);
  prepare();
}

FrameWriter FrameFolder::open(FrameFormat format, const FrameMesh& mesh) const {
  for (const std::filesystem::path& file : old_files()) remove_file(file);
  return {folder_.string(), format, mesh};
}

}  // namespace pleat
