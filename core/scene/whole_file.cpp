#include "core/scene/whole_file.h"

#include <fstream>
#include <iterator>
#include <system_error>

#include "core/base/check.h"

namespace pleat {

std::string read_file(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InputError(path.string(), "expected a file, got a folder");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string(), "expected a file that can be read, got none");
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad()) throw InputError(path.string(), "the file could not be read to its end");
  return bytes;
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  std::filesystem::path beside = path;
  beside += ".part";
  std::ofstream file(beside, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(beside, path, error);
  if (!file || error) {
    std::filesystem::remove(beside, error);
    throw InputError(path.string(), "expected a place that can be written to");
  }
}

void make_folder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error || !std::filesystem::is_directory(path))
    throw InputError(path.string(), "expected a folder or a place for one");
}

}  // namespace pleat
