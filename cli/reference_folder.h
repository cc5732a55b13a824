#pragma once

#include <filesystem>

#include "core/reference/reference.h"

namespace pleat {

/// Keeps references as files, one per id: a changed scene, method or core has another id and never
/// meets an old one.
class ReferenceFolder : public ReferenceStore {
 public:
  /// Makes the folder. Throws FileError when nothing can be kept in it.
  explicit ReferenceFolder(std::filesystem::path folder, Precision precision = Precision::float64);

  /// A file that cannot be read as a reference counts as none.
  std::optional<Reference> find(const std::string& id) override;
  void keep(const Reference& reference) override;

  /// Names the file that one is kept in.
  std::filesystem::path path(const std::string& id) const { return folder_ / (id + ".reference"); }

 private:
  std::filesystem::path folder_;
  Precision precision_;
};

}  // namespace pleat
