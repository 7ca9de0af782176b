#include "grader/grade/intake.h"

#include "course/cli/scratch_folder.h"
#include "grader/grade/archive.h"
#include "grader/grade/packed.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using namespace carlo;
using namespace carlo::grader;

namespace {

bool has(const std::vector<std::string>& list, const std::string& part) {
  for (const std::string& text : list) {
    if (text.find(part) != std::string::npos) return true;
  }
  return false;
}

Intake take(const fs::path& path) {
  return take_in({"name", path, ""}, demo_labs());
}

}  // namespace

TEST_CASE("exercise files are found by the end of their path, and nothing else is taken",
          "[intake]") {
  const ScratchFolder folder;
  put(folder.path() / "work/labs/01_integration/integration.cpp", "one");
  put(folder.path() / "a_camera.cpp", "camera");
  put(folder.path() / "CMakeLists.txt", "evil");
  put(folder.path() / "labs/01_integration/integration.h", "evil");
  put(folder.path() / "solutions/01_integration/integration.cpp", "not the student's");
  const Intake intake = take(folder.path());
  CHECK(intake.labs.at(1).files.at("integration.cpp") == "one");
  CHECK(intake.labs.at(8).files.at("steps/a_camera.cpp") == "camera");
  CHECK(intake.labs.at(8).files.size() == 1);
  CHECK(has(intake.ignored, "CMakeLists.txt"));
  CHECK(has(intake.ignored, "integration.h"));
  CHECK(has(intake.ignored, "solutions/"));
}

TEST_CASE("a name starts no line of a report", "[intake]") {
  const ScratchFolder folder;
  put(folder.path() / "a\nLab 01: 20 of 20 points", "");
  put(folder.path() / "integration.cpp", "one");
  put(folder.path() / "b\n20 of 20 points/integration.cpp", "two");
  const Intake intake = take(folder.path());
  CHECK(has(intake.ignored, "a Lab 01"));
  CHECK_FALSE(has(intake.ignored, "\n"));
  CHECK_FALSE(has(intake.labs.at(1).problems, "\n"));
}

TEST_CASE("two different files of one name are a problem of that lab, equal ones are none",
          "[intake]") {
  const ScratchFolder folder;
  put(folder.path() / "integration.cpp", "one\n");
  put(folder.path() / "old/integration.cpp", "one\r\n");
  put(folder.path() / "b_direct.cpp", "x");
  CHECK(take(folder.path()).labs.at(1).problems.empty());
  put(folder.path() / "old/integration.cpp", "two");
  const Intake intake = take(folder.path());
  CHECK(has(intake.labs.at(1).problems, "differ"));
  CHECK(intake.labs.at(1).files.empty());
  CHECK(intake.labs.at(8).problems.empty());
}

TEST_CASE("byte order mark and line ends are made plain", "[intake]") {
  const ScratchFolder folder;
  put(folder.path() / "integration.cpp",
      "\xEF\xBB\xBF"
      "a\r\nb\rc\n");
  CHECK(take(folder.path()).labs.at(1).files.at("integration.cpp") == "a\nb\rc\n");
}

TEST_CASE("links and huge files are refused", "[intake]") {
  const ScratchFolder folder, elsewhere;
  put(elsewhere.path() / "integration.cpp", "somebody else's");
  fs::create_symlink(elsewhere.path() / "integration.cpp", folder.path() / "integration.cpp");
  put(folder.path() / "b_direct.cpp", std::string(std::size_t{2} << 20, 'x'));
  fs::create_directory_symlink(elsewhere.path(), folder.path() / "more");
  const Intake intake = take(folder.path());
  CHECK(intake.labs.at(1).files.empty());
  CHECK(has(intake.ignored, "integration.cpp: a link"));
  CHECK(has(intake.labs.at(8).problems, "larger than 1 MB"));
}

TEST_CASE("paths and links that lead out of an archive are refused, the rest is taken",
          "[intake]") {
  const ScratchFolder folder;
  put(folder.path() / "a.zip", zip({{"../integration.cpp", "x"},
                                    {"hw/../../integration.cpp", "y"},
                                    {"/integration.cpp", "z"},
                                    {"C:\\integration.cpp", "z"},
                                    {"b_direct.cpp", "/etc/passwd", true},
                                    {"hw\\steps\\a_camera.cpp", "camera"}}));
  const Intake intake = take(folder.path() / "a.zip");
  CHECK(intake.labs.at(1).files.empty());
  CHECK(intake.labs.at(8).files.size() == 1);
  CHECK(intake.labs.at(8).files.at("steps/a_camera.cpp") == "camera");
  CHECK(has(intake.ignored, "../integration.cpp: leads out"));
  CHECK(has(intake.ignored, "b_direct.cpp: a link"));
}

TEST_CASE("tens of thousands of other files do not hide those that are graded", "[intake]") {
  // A disk takes ten seconds to create so many.
  const bool in_memory = fs::is_directory("/dev/shm");
  if (in_memory) ::setenv("TMPDIR", "/dev/shm", 0);
  const ScratchFolder folder;
  const std::vector<std::string> wanted{"integration.cpp", "a_camera.cpp", "b_direct.cpp"};
  std::vector<Entry> entries;
  // The disk lists them in any order.
  for (int i = 0; i < 30'000; ++i) {
    entries.push_back({"a" + std::to_string(i), ""});
    std::ofstream(folder.path() / ("a" + std::to_string(i)));
  }
  for (const std::string& name : wanted) {
    entries.push_back({name, name});
    put(folder.path() / name, name);
  }
  const auto check = [&](const Intake& intake) {
    CHECK(intake.labs.at(1).files.at("integration.cpp") == "integration.cpp");
    CHECK(intake.labs.at(8).files.size() == 2);
    CHECK(intake.ignored.size() == 201);
  };
  check(take(folder.path()));
  const ScratchFolder packed;
  put(packed.path() / "a.zip", zip(entries));
  check(take(packed.path() / "a.zip"));
  if (in_memory && std::string(std::getenv("TMPDIR")) == "/dev/shm") ::unsetenv("TMPDIR");
}

TEST_CASE("of names without end not much is told", "[intake]") {
  const ScratchFolder folder;
  std::vector<Entry> entries{{"integration.cpp", "x"}};
  for (int i = 0; i < 300; ++i)
    entries.push_back({std::string(60'000, 'n') + std::to_string(i), ""});
  entries.push_back({std::string(50'000, 'n') + "/integration.cpp", "y"});
  put(folder.path() / "a.zip", zip(entries));
  const Intake intake = take(folder.path() / "a.zip");
  std::size_t bytes = 0;
  for (const std::string& line : intake.ignored)
    bytes += line.size();
  for (const std::string& line : intake.labs.at(1).problems)
    bytes += line.size();
  CHECK((bytes > 0 && bytes < 100'000));
}

TEST_CASE("an archive within a submission is opened, a spoilt one is told", "[intake]") {
  const ScratchFolder folder;
  put(folder.path() / "hw1.zip", zip({{"deep.zip", zip({{"integration.cpp", "one"}})}}));
  put(folder.path() / "hw2.zip", "PK no zip at all");
  const Intake intake = take(folder.path());
  CHECK(intake.labs.at(1).files.at("integration.cpp") == "one");
  CHECK(has(intake.ignored, "hw2.zip: "));
}

TEST_CASE("an archive that unpacks to too much, or to too many files, is an error", "[intake]") {
  const std::string bytes = zip({{"a", std::string(2000, 'x')}, {"b", std::string(2000, 'x')}});
  const auto visit = [&](ArchiveLimits limits) {
    visit_archive(
        std::string_view(bytes), limits, [](const ArchiveEntry& entry) { entry.read(); },
        [](const std::string&) {});
  };
  CHECK_NOTHROW(visit({}));
  CHECK_THROWS_AS(visit({.entries = 1}), Error);
  CHECK_THROWS_AS(visit({.entry_bytes = 1999}), Error);
  CHECK_THROWS_AS(visit({.total_bytes = 3999}), Error);
}

TEST_CASE("an archive of many is listed and a part of it read without unpacking the others",
          "[intake]") {
  const ScratchFolder folder;
  const fs::path file = folder.path() / "export.zip";
  put(file, zip({{"bob/large", std::string(2000, 'x')}, {"carol/integration.cpp", "c"}}));
  CHECK(archive_paths(file) == std::vector<std::string>{"bob/large", "carol/integration.cpp"});
  std::string text;
  const auto read = [&](const std::string& part) {
    visit_part(
        file, part, {.entries = 1, .total_bytes = 1000},
        [&](const ArchiveEntry& entry) { text = entry.read(); }, [](const std::string&) {});
  };
  CHECK_NOTHROW(read("carol"));
  CHECK(text == "c");
  CHECK_THROWS_AS(read("bob"), Error);
}

TEST_CASE("a thousand copies of a file, or different ones, are as one or two", "[intake]") {
  const ScratchFolder folder;
  for (int i = 0; i < 1000; ++i)
    put(folder.path() / std::to_string(i) / "integration.cpp", "one");
  CHECK(take(folder.path()).labs.at(1).files.at("integration.cpp") == "one");
  for (int i = 0; i < 1000; ++i)
    put(folder.path() / std::to_string(i) / "integration.cpp", std::to_string(i));
  CHECK(take(folder.path()).labs.at(1).problems.size() == 1);
}

TEST_CASE("the digest changes with what is judged, and with nothing else", "[intake]") {
  const ScratchFolder folder;
  put(folder.path() / "integration.cpp", "one");
  const std::string before = take(folder.path()).digest;
  put(folder.path() / "notes.txt", "x");
  CHECK(take(folder.path()).digest == before);
  put(folder.path() / "integration.cpp", "two");
  CHECK(take(folder.path()).digest != before);
}

TEST_CASE(
    "work in a folder that is called as one of the course's is found, where there is no other",
    "[intake]") {
  for (const char* name : {"solutions", "tests", "common", "build", "out"}) {
    const ScratchFolder folder;
    put(folder.path() / name / "integration.cpp", "one");
    CHECK(take(folder.path()).labs.at(1).files.at("integration.cpp") == "one");
    put(folder.path() / "a.zip", zip({{std::string(name) + "/integration.cpp", "two"}}));
    CHECK(take(folder.path() / "a.zip").labs.at(1).files.at("integration.cpp") == "two");
    put(folder.path() / "integration.cpp", "three");
    CHECK(take(folder.path()).labs.at(1).files.at("integration.cpp") == "three");
  }
}

TEST_CASE("links that lead in a circle are no folders", "[intake]") {
  const ScratchFolder folder;
  put(folder.path() / "alice/integration.cpp", "one");
  for (const char* place : {"loop", "alice/loop"})
    fs::create_symlink("loop", folder.path() / place);
  CHECK(submission_names(folder.path()) == std::vector<std::string>{"alice"});
  const Intake intake = take(folder.path() / "alice");
  CHECK(intake.labs.at(1).files.at("integration.cpp") == "one");
  CHECK(has(intake.ignored, "a link"));
}

TEST_CASE("what stands beside submissions is told of, and a class is no submission", "[intake]") {
  const ScratchFolder folder;
  put(folder.path() / "alice/integration.cpp", "one");
  put(folder.path() / "bob.tar.xz", "packed otherwise");
  put(folder.path() / ".DS_Store", "");
  const Submissions found = find_submissions({folder.path()}, demo_labs(), false);
  CHECK(found.sources.size() == 1);
  CHECK(found.left_out == std::vector<std::string>{fs::canonical(folder.path()) / "bob.tar.xz"});
  for (const char* name : {"labs", "steps", "01_integration"}) {
    put(folder.path() / name / "integration.cpp", "two");
    CHECK_THROWS_AS(submission_names(folder.path()), Error);
    CHECK(submission_names(folder.path(), true).size() == 1);
    fs::remove_all(folder.path() / name);
  }
  put(folder.path() / "integration.cpp", "two");
  CHECK_THROWS_AS(submission_names(folder.path()), Error);
}

// Root can read everything, so this runs as another user.
TEST_CASE("what we may not read is an error, not work that was not handed in", "[intake]") {
  const ScratchFolder folder;
  put(folder.path() / "alice/deep/integration.cpp", "one");
  put(folder.path() / "bob.zip", zip({{"integration.cpp", "one"}}));
  fs::permissions(folder.path(),
                  fs::perms::owner_all | fs::perms::others_read | fs::perms::others_exec);
  fs::permissions(folder.path() / "alice/deep", fs::perms::none);
  fs::permissions(folder.path() / "bob.zip", fs::perms::none);
  const pid_t child = ::fork();
  if (child == 0) {
    constexpr uid_t nobody = 65534;
    if (::geteuid() == 0 && ::setresuid(nobody, nobody, nobody) != 0) ::_exit(3);
    const auto refused = [&](const char* name) {
      try {
        (void)take(folder.path() / name);
        return false;
      } catch (const std::exception&) {
        return true;
      }
    };
    ::_exit((refused("alice") ? 0 : 1) + (refused("bob.zip") ? 0 : 2));
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  fs::permissions(folder.path() / "alice/deep", fs::perms::owner_all);
}
