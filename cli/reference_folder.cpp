#include "cli/reference_folder.h"

#include "core/files/whole_file.h"

namespace pleat {

ReferenceFolder::ReferenceFolder(std::filesystem::path folder, Precision precision)
    : folder_(std::move(folder)), precision_(precision) {
  make_folder(folder_);
  check_writable(path("any"));
}

std::optional<Reference> ReferenceFolder::find(const std::string& id) {
  std::error_code error;
  if (!std::filesystem::exists(path(id), error)) return std::nullopt;
  try {
    Reference reference = read_reference(read_file(path(id)));
    if (reference.label.id == id) return reference;
  } catch (const InputError&) {
  }
  return std::nullopt;
}

void ReferenceFolder::keep(const Reference& reference) {
  write_file(path(reference.label.id), write_reference(reference, precision_));
}

}  // namespace pleat
