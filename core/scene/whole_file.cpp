#include "core/scene/whole_file.h"

#include <fstream>
#include <iterator>
#include <system_error>

namespace pleat {
namespace {

[[noreturn]] void throw_unreadable(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) throw FileError(path, "expected a file, got a folder");
  if (status.type() == std::filesystem::file_type::not_found)
    throw FileError(path, "expected a file, got none of this name");
  throw FileError(path, "expected a file that may be read, got one that is not permitted");
}

[[noreturn]] void throw_unwritable(const std::filesystem::path& path) {
  throw FileError(path, "expected a place that can be written to");
}

/// Where a file stands until it is whole.
std::filesystem::path part_of(const std::filesystem::path& path) {
  std::filesystem::path part = path;
  part += ".part";
  return part;
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  std::error_code error;
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path, error)) throw_unreadable(path);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad()) throw FileError(path, "expected a file that can be read to its end");
  return bytes;
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  const std::filesystem::path part = part_of(path);
  std::ofstream file(part, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(part, path, error);
  if (!file || error) {
    std::filesystem::remove(part, error);
    throw_unwritable(path);
  }
}

void check_writable(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status))
    throw FileError(path, "expected a file or a place for one, got a folder");
  // Renaming would put a plain file in the place of a device or pipe.
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw FileError(path, "expected a file or a place for one, got a device");
  const bool opened = std::ofstream(part_of(path), std::ios::binary).is_open();
  if (!opened) throw_unwritable(path);
  std::filesystem::remove(part_of(path), error);
}

void remove_file(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::remove(path, error);
  if (error) throw FileError(path, "expected a file that can be removed");
}

void make_folder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error || !std::filesystem::is_directory(path, error))
    throw FileError(path, "expected a folder or a place for one");
}

}  // namespace pleat
