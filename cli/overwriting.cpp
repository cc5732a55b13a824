#include "cli/overwriting.h"

#include <string>

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

}  // namespace pleat
