#include "grader/grade/apart.h"

#include "course/cli/scratch_folder.h"
#include "grader/judge/landlock.h"
#include "grader/judge/process.h"
#include "grader/unit/memory_limits.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_exception.hpp>
#include <sys/socket.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

using namespace carlo;
using namespace carlo::grader;

TEST_CASE("what a child returns comes back byte for byte", "[apart]") {
  const ScratchFolder folder;
  CHECK(apart(folder.path(), [] { return std::string(); }).empty());
  const std::string bytes("\0\xFF\x80 text\n", 9);
  CHECK(apart(folder.path(), [&] { return std::string(bytes); }) == bytes);
  const std::string large(std::size_t{5} << 20, 'x');
  CHECK(apart(folder.path(), [&] { return std::string(large); }) == large);
}

TEST_CASE("an Error in the child is the caller's", "[apart]") {
  const ScratchFolder folder;
  CHECK_THROWS_MATCHES(
      apart(folder.path(), []() -> std::string { throw Error("spoilt at byte {}", 7); }), Error,
      Catch::Matchers::Message("spoilt at byte 7"));
}

TEST_CASE("a child that crashes or ends without an answer ends nothing else", "[apart]") {
  const ScratchFolder folder;
  CHECK_THROWS_AS(apart(folder.path(),
                        []() -> std::string {
                          std::signal(SIGABRT, SIG_DFL);  // Catch2's handler would report it
                          std::abort();
                        }),
                  Error);
  CHECK_THROWS_AS(apart(folder.path(), []() -> std::string { std::_Exit(0); }), Error);
  CHECK_THROWS_AS(apart(folder.path(),
                        []() -> std::string {
                          ::raise(SIGKILL);
                          return "still there";
                        }),
                  Error);
}

TEST_CASE("a child may not take all memory", "[apart]") {
  if (address_sanitizer()) SKIP("the sanitizer takes more than any limit");
  if (!grader_test::memory_limits_hold()) SKIP("this system has no limits of memory");
  const ScratchFolder folder;
  CHECK_THROWS_AS(apart(folder.path(),
                        [] {
                          const std::vector<char> all(std::size_t{3} << 30);
                          return std::string(1, all.back());
                        }),
                  Error);
}

TEST_CASE("a child writes no file", "[apart]") {
  const ScratchFolder folder;
  const auto file = folder.path() / "written";
  CHECK_THROWS_AS(apart(folder.path(),
                        [&] {
                          std::ofstream(file) << "something" << std::flush;
                          return read_file(file);
                        }),
                  Error);
}

TEST_CASE("a child reads what it is given, and nothing else where the kernel sees to that",
          "[apart]") {
  const ScratchFolder folder, other;
  write_file(folder.path() / "mine", "one");
  write_file(other.path() / "theirs", "two");
  CHECK(apart(folder.path(), [&] { return read_file(folder.path() / "mine"); }) == "one");
  if (landlock_version() == 0) SKIP("the kernel has no Landlock");
  CHECK_THROWS_AS(apart(folder.path(), [&] { return read_file(other.path() / "theirs"); }), Error);
  CHECK(apart(folder.path(), [] {
          return std::string(::socket(AF_INET, SOCK_STREAM, 0) < 0 ? "refused" : "open");
        }) == "refused");
}
