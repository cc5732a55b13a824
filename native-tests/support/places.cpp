#include "native-tests/support/places.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iostream>
#include <string_view>

#include "native-tests/support/assets.h"

namespace pleat {
namespace {

constexpr const char* kRoots[] = {"core",    "cli",   "wasm",        "web/src",
                                  "scripts", "pleat", "docs/methods"};

bool goes_on(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

bool names(std::string_view text, std::string_view word) {
  for (std::size_t at = text.find(word); at != std::string_view::npos;
       at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !goes_on(text[at - 1]);
    if (begins && (end == text.size() || !goes_on(text[end]))) return true;
  }
  return false;
}

/// Files below a folder, or the one file that it is, by their paths in the repository. What a build
/// has put there is left out.
std::vector<std::string> files_of(const std::string& root) {
  namespace fs = std::filesystem;
  if (fs::is_regular_file(repository_path(root))) return {root};
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(repository_path(root))) {
    const std::string path = entry.path().generic_string().substr(repository_path("").size());
    if (entry.is_regular_file() && path.rfind("web/src/wasm/", 0) != 0) files.push_back(path);
  }
  return files;
}

std::string without_ending(const std::string& file) {
  const std::filesystem::path path(file);
  const bool is_cpp = path.extension() == ".h" || path.extension() == ".cpp";
  return is_cpp ? std::filesystem::path(path).replace_extension().generic_string() : file;
}

}  // namespace

std::set<std::string> files_naming(std::initializer_list<std::string> words) {
  std::set<std::string> found;
  for (const char* root : kRoots)
    for (const std::string& file : files_of(root)) {
      const std::string text = repository_file(file);
      const auto stands = [&](const std::string& word) { return names(text, word); };
      if (std::any_of(words.begin(), words.end(), stands)) found.insert(without_ending(file));
    }
  return found;
}

void tell_places(const std::string& what, std::size_t number) {
  std::cout << "places " << what << ' ' << number << std::endl;
}

}  // namespace pleat
