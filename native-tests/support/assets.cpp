#include "native-tests/support/assets.h"

#include <fstream>
#include <iterator>

namespace pleat {

std::string repository_path(const std::string& path) {
  return std::string(PLEAT_SOURCE_DIR) + "/" + path;
}

std::string repository_file(const std::string& path) {
  std::ifstream file(repository_path(path), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

const FabricLibrary& fabric_library() {
  static const FabricLibrary library = read_fabrics(repository_file("assets/fabrics/fabrics.json"));
  return library;
}

std::string scene_text(const std::string& name) {
  return repository_file("assets/scenes/" + name + ".json");
}

}  // namespace pleat
