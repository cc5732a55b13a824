#include "core/scene/whole_file.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>

using namespace pleat;
namespace fs = std::filesystem;

namespace {

/// A folder of its own for one test, gone afterwards.
class ScratchFolder {
 public:
  explicit ScratchFolder(const char* name) : path_(fs::temp_directory_path() / name) {
    fs::remove_all(path_);
    fs::create_directory(path_);
  }
  ~ScratchFolder() { fs::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  fs::path operator/(const char* name) const { return path_ / name; }

 private:
  fs::path path_;
};

/// What the work says is wrong with the file at `path`.
template <class Work>
std::string complaint(const fs::path& path, Work&& work) {
  try {
    work(path);
  } catch (const FileError& error) {
    CHECK(error.where() == path.string());
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("whole file: a file that cannot be read is told from none and from a folder", "[scene]") {
  const ScratchFolder folder("pleat_whole_file_read");
  const auto read = [](const fs::path& path) { read_file(path); };
  CHECK(complaint(folder / "missing", read) == "expected a file, got none of this name");
  CHECK(complaint("/dev/null/below", read) == "expected a file, got none of this name");
  CHECK(complaint(folder / "", read) == "expected a file, got a folder");
  if (geteuid() == 0) return;  // may read everything
  write_file(folder / "locked", "");
  fs::permissions(folder / "locked", fs::perms::none);
  CHECK(complaint(folder / "locked", read) ==
        "expected a file that may be read, got one that is not permitted");
}

TEST_CASE("whole file: looking whether a file can be written changes nothing", "[scene]") {
  const ScratchFolder folder("pleat_whole_file_check");
  write_file(folder / "kept", "as it was");
  check_writable(folder / "kept");
  check_writable(folder / "new");
  CHECK(read_file(folder / "kept") == "as it was");
  CHECK(std::distance(fs::directory_iterator(folder / ""), {}) == 1);
  CHECK(complaint(folder / "", check_writable) != "none");
  CHECK(complaint(folder / "missing/new", check_writable) != "none");
  CHECK(complaint("/dev/null", check_writable) != "none");
}
