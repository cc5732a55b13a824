#include "cli/overwriting.h"

#include <string>

#include "core/files/frame_file.h"
#include "core/files/whole_file.h"

namespace pleat {

Overwriting::Overwriting(Arguments& arguments) : is_asked_(arguments.flag("--overwrite")) {
  if (const auto fabrics = Arguments(arguments).text("--fabrics")) spare({*fabrics});
}

void Overwriting::need(bool has_output, const char* options) const {
  if (is_asked_ && !has_output)
    throw InputError("--overwrite", std::string("expected ") + options + " beside it, got none");
}

void Overwriting::spare(const std::vector<std::filesystem::path>& files) {
  spared_.insert(spared_.end(), files.begin(), files.end());
}

void Overwriting::check_spared(const std::filesystem::path& file) const {
  std::error_code error;  // of a file that is not there
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

std::vector<std::filesystem::path> prepare_frame_folder(
    const std::optional<std::string>& folder, Overwriting& overwriting,
    const std::vector<std::filesystem::path>& files) {
  overwriting.spare(files);
  if (!folder) return {};
  std::vector<std::filesystem::path> old = frame_files(*folder);
  if (!old.empty() && !overwriting.is_asked())
    throw FileError(*folder, "expected a folder without frames, got " +
                                 old.front().filename().string() +
                                 "; --overwrite removes those that stand there");
  for (const std::filesystem::path& file : old) overwriting.check(file);
  make_folder(*folder);
  return old;
}

}  // namespace pleat
