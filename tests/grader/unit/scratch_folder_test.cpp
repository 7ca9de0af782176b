// A scratch folder is removed with everything left in it.

#include "course/cli/scratch_folder.h"

#include "grader/judge/watch.h"

#include <catch2/catch_test_macros.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <fstream>

using carlo::ScratchFolder;
using carlo::grader::fuller_than;
namespace fs = std::filesystem;

namespace {

/// Nests folders; the deepest holds a file.
void dig(const fs::path& top, int levels) {
  int at = ::open(top.c_str(), O_RDONLY | O_DIRECTORY);
  for (int i = 0; i < levels; ++i) {
    REQUIRE(::mkdirat(at, "d", 0700) == 0);
    const int next = ::openat(at, "d", O_RDONLY | O_DIRECTORY);
    ::close(at);
    at = next;
  }
  ::close(::openat(at, "file", O_WRONLY | O_CREAT, 0600));
  ::close(at);
}

}  // namespace

TEST_CASE("a scratch folder that is deeper than any path can name goes too", "[scratch]") {
  fs::path path;
  {
    const ScratchFolder scratch;
    path = scratch.path();
    dig(path, 2500);  // "/d" each; a path has at most 4096 characters
    CHECK(fuller_than(path, {}, std::size_t{1} << 30));
  }
  CHECK_FALSE(fs::exists(path));
}

TEST_CASE("closed folders go, and what links lead to stays", "[scratch]") {
  const ScratchFolder other;
  std::ofstream(other.path() / "kept.txt") << "kept";
  fs::path path;
  {
    const ScratchFolder scratch;
    path = scratch.path();
    dig(path, 3);
    fs::create_directory_symlink(other.path(), path / "d" / "link");
    fs::create_directory_symlink(other.path(), path / "link");
    fs::permissions(path / "d" / "d", fs::perms::none);
    CHECK_FALSE(fuller_than(path, {}, std::size_t{1} << 30));
  }
  CHECK_FALSE(fs::exists(path));
  CHECK(fs::exists(other.path() / "kept.txt"));
}
