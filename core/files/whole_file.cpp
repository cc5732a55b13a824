#include "core/files/whole_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <system_error>
#include <vector>

namespace pleat {
namespace {

namespace fs = std::filesystem;

std::string quoted(const std::error_code& error) { return '"' + error.message() + '"'; }

std::error_code last_error() { return {errno, std::generic_category()}; }

[[noreturn]] void throw_unreadable(const fs::path& path, const std::error_code& cause) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) throw FileError(path, "expected a file, got a folder");
  if (status.type() == fs::file_type::not_found)
    throw FileError(path, "expected a file, got none of this name");
  throw FileError(path, "expected a file that can be read, got " + quoted(cause));
}

[[noreturn]] void throw_unwritable(const fs::path& path, const std::error_code& cause) {
  throw FileError(path, "expected a place that can be written to, got " + quoted(cause));
}

[[noreturn]] void throw_device(const fs::path& path) {
  throw FileError(path, "expected a file or a place for one, got a device");
}

[[noreturn]] void throw_too_large(const fs::path& path) {
  throw FileError(path, "expected a file of at most 1 GiB, got more");
}

/// Refuses names and kinds of file whose faults opening them would not tell.
void check_readable_kind(const fs::path& path) {
  if (path.native().find('\0') != fs::path::string_type::npos)
    throw FileError(path, "expected the name of a file, got one with a zero byte");
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_other(status) && !fs::is_fifo(status))
    throw FileError(path, "expected a file, got a device");
  if (fs::is_regular_file(status) && fs::file_size(path, error) > kMostBytesOfFile && !error)
    throw_too_large(path);
}

/// Links below /proc are open files, whatever name they show.
bool is_open_file(const fs::path& link) {
  std::error_code error;
  return fs::canonical(link.parent_path(), error).string().rfind("/proc/", 0) == 0;
}

/// The file behind links, which need not exist. Throws FileError for what is no regular file:
/// renaming would put one in the place of a device or pipe.
fs::path target_of(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status))
    throw FileError(path, "expected a file or a place for one, got a folder");
  if (fs::status_known(status) && fs::exists(status) && !fs::is_regular_file(status))
    throw_device(path);
  if (error && status.type() != fs::file_type::not_found) throw_unwritable(path, error);
  fs::path target = path;
  while (fs::is_symlink(fs::symlink_status(target, error))) {  // ends, as `status` found an end
    if (is_open_file(target)) throw_device(path);
    const fs::path link = fs::read_symlink(target, error);
    if (error) throw_unwritable(path, error);
    target = target.parent_path() / link;
  }
  return target;
}

/// A file that is not whole yet: it stands beside its target, under a name that nothing had.
class PartFile {
 public:
  /// Throws FileError naming `path`.
  PartFile(const fs::path& path, const fs::path& target) {
    const std::string prefix = ".pleat-" + std::to_string(getpid()) + "-";
    std::FILE* file = nullptr;
    for (int attempt = 0; file == nullptr; ++attempt) {
      part_ = target.parent_path() / (prefix + std::to_string(attempt) + ".part");
      file = std::fopen(part_.c_str(), "wbx");  // fails for a file that exists
      if (file == nullptr && errno != EEXIST) throw_unwritable(path, last_error());
    }
    std::fclose(file);
  }
  ~PartFile() {
    std::error_code error;
    if (!part_.empty()) fs::remove(part_, error);
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  std::error_code write(std::string_view bytes) const {
    errno = EIO;  // cause of a failure that names none
    std::ofstream file(part_, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    return file ? std::error_code() : last_error();
  }

  std::error_code rename_to(const fs::path& target) {
    std::error_code error;
    fs::rename(part_, target, error);
    if (!error) part_.clear();
    return error;
  }

 private:
  fs::path part_;
};

/// The folder and those above it that are not there, the deepest first.
std::vector<fs::path> missing_folders(const fs::path& path) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path folder = path; folder.has_relative_path(); folder = folder.parent_path())
    if (fs::symlink_status(folder, error).type() == fs::file_type::not_found)
      missing.push_back(folder);
  return missing;
}

}  // namespace

std::string read_file(const fs::path& path) {
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  check_readable_kind(path);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  const std::error_code cause = last_error();
  std::error_code error;
  if (!file || fs::is_directory(path, error)) throw_unreadable(path, cause);
  std::string bytes;
  while (file) {  // the file may grow meanwhile, whatever its size was said to be
    const std::size_t start = bytes.size();
    bytes.resize(start + kBlock);
    file.read(bytes.data() + start, kBlock);
    bytes.resize(start + static_cast<std::size_t>(file.gcount()));
    if (bytes.size() > kMostBytesOfFile) throw_too_large(path);
  }
  if (file.bad()) throw FileError(path, "expected a file that can be read to its end");
  return bytes;
}

void write_file(const fs::path& path, std::string_view bytes) {
  const fs::path target = target_of(path);
  PartFile part(path, target);
  if (const std::error_code error = part.write(bytes)) throw LostOutput(path, quoted(error));
  if (const std::error_code error = part.rename_to(target)) throw LostOutput(path, quoted(error));
}

void check_writable(const fs::path& path) { const PartFile part(path, target_of(path)); }

void remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw FileError(path, "expected a file that can be removed, got " + quoted(error));
}

void make_folder(const fs::path& path) {
  const std::vector<fs::path> missing = missing_folders(path);
  std::error_code error;
  fs::create_directories(path, error);
  std::error_code ignored;
  if (!error && fs::is_directory(path, ignored)) return;
  for (const fs::path& folder : missing) fs::remove(folder, ignored);
  throw FileError(path, "expected a folder or a place for one" +
                            (error ? ", got " + quoted(error) : std::string()));
}

}  // namespace pleat
