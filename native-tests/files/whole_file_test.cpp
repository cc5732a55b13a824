#include "core/files/whole_file.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "native-tests/support/scratch_folder.h"

using namespace pleat;
namespace fs = std::filesystem;

namespace {

/// The fault that the work finds with the file at `path`.
template <class Work>
std::string complaint(const fs::path& path, Work&& work) {
  try {
    work(path);
  } catch (const FileError& error) {
    CHECK(error.where() == path.string());
    return error.sentence();
  }
  return "none";
}

}  // namespace

TEST_CASE("whole file: a file that cannot be read is told from none and from a folder", "[files]") {
  const ScratchFolder folder;
  const auto read = [](const fs::path& path) { read_file(path); };
  CHECK(complaint(folder / "missing", read) == "expected a file, got none of this name");
  CHECK(complaint("/dev/null/below", read) == "expected a file, got none of this name");
  CHECK(complaint(folder / "", read) == "expected a file, got a folder");
  CHECK(complaint(folder / std::string(300, 'x'), read) ==
        "expected a file that can be read, got \"File name too long\"");
  if (geteuid() == 0) return;  // may read everything
  write_file(folder / "locked", "");
  fs::permissions(folder / "locked", fs::perms::none);
  CHECK(complaint(folder / "locked", read) ==
        "expected a file that can be read, got \"Permission denied\"");
}

TEST_CASE("whole file: a device and a name with a zero byte are refused, a pipe is read",
          "[files]") {
  const auto read = [](const fs::path& path) { read_file(path); };
  for (const char* device : {"/dev/zero", "/dev/null"})
    CHECK(complaint(device, read) == "expected a file, got a device");
  CHECK(complaint(std::string("a\0b", 3), read) ==
        "expected the name of a file, got one with a zero byte");
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  REQUIRE(::write(ends[1], "piped", 5) == 5);
  close(ends[1]);
  CHECK(read_file("/proc/self/fd/" + std::to_string(ends[0])) == "piped");
  close(ends[0]);
}

TEST_CASE("whole file: a file that is too large is refused before it is read", "[files]") {
  const ScratchFolder folder;
  write_file(folder / "huge", "");
  fs::resize_file(folder / "huge", kMostBytesOfFile + 1);  // takes no place
  CHECK(complaint(folder / "huge", [](const fs::path& path) { read_file(path); }) ==
        "expected a file of at most 1 GiB, got more");
}

TEST_CASE("whole file: looking whether a file can be written changes nothing", "[files]") {
  const ScratchFolder folder;
  write_file(folder / "kept", "as it was");
  check_writable(folder / "kept");
  check_writable(folder / "new");
  CHECK(read_file(folder / "kept") == "as it was");
  CHECK(std::distance(fs::directory_iterator(folder / ""), {}) == 1);
  CHECK(complaint(folder / "", check_writable) != "none");
  CHECK(complaint(folder / "missing/new", check_writable) != "none");
  CHECK(complaint("/dev/null", check_writable) != "none");
}

TEST_CASE("whole file: what is written goes through links, which stay", "[files]") {
  const ScratchFolder folder;
  fs::create_directory(folder / "below");
  write_file(folder / "below/file", "old");
  fs::create_symlink("below/file", folder / "near");
  fs::create_symlink(folder / "near", folder / "far");
  fs::create_symlink("below/new", folder / "dangling");
  for (const char* link : {"near", "far", "dangling"}) {
    CAPTURE(link);
    check_writable(folder / link);
    write_file(folder / link, link);
    CHECK(fs::is_symlink(folder / link));
    CHECK(read_file(folder / link) == link);
  }
  CHECK(read_file(folder / "below/file") == "far");
  CHECK(read_file(folder / "below/new") == "dangling");
}

TEST_CASE("whole file: a device behind a link is refused and stays", "[files]") {
  const ScratchFolder folder;
  fs::create_symlink("/dev/null", folder / "device");
  fs::create_symlink("loop", folder / "loop");
  const auto write = [](const fs::path& path) { write_file(path, "bytes"); };
  for (const char* link : {"device", "loop"}) {
    CAPTURE(link);
    CHECK(complaint(folder / link, check_writable) != "none");
    CHECK(complaint(folder / link, write) != "none");
    CHECK(fs::is_symlink(folder / link));
  }
  // The test's own output, which may be a file.
  CHECK(complaint("/proc/self/fd/1", check_writable) ==
        "expected a file or a place for one, got a device");
}

TEST_CASE("whole file: no file beside the one written is touched", "[files]") {
  const ScratchFolder folder;
  const std::string part = ".pleat-" + std::to_string(getpid()) + "-0.part";
  for (const std::string& name : {std::string("file.part"), part})
    std::ofstream(folder / name) << "mine";
  const std::string longest(255, 'x');
  for (const std::string& name : {std::string("file"), longest}) {
    check_writable(folder / name);
    write_file(folder / name, "whole");
    CHECK(read_file(folder / name) == "whole");
  }
  CHECK(read_file(folder / "file.part") == "mine");
  CHECK(read_file(folder / part) == "mine");
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 4);
}

TEST_CASE("whole file: a folder that cannot be made leaves none above it", "[files]") {
  const ScratchFolder folder;
  fs::create_symlink("nowhere", folder / "dangling");
  CHECK(complaint(folder / "a" / "b" / std::string(300, 'x'), make_folder) ==
        "expected a folder or a place for one, got \"File name too long\"");
  CHECK(complaint(folder / "dangling", make_folder) != "none");
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
  make_folder(folder / "a" / "b");
  CHECK(fs::is_directory(folder / "a" / "b"));
}
