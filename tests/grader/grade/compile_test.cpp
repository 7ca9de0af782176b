// Tests, with a fake compiler, whose fault a failed compilation is.

#include "grader/grade/compile.h"

#include "course/cli/scratch_folder.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <filesystem>
#include <string>
#include <vector>

using namespace carlo;
using namespace carlo::grader;
namespace fs = std::filesystem;

namespace {

constexpr const char* full_disk =
    "cc1plus: fatal error: error writing to x.s: No space left on device";
constexpr const char* no_process =
    "c++: fatal error: cannot execute 'cc1plus': vfork: Resource temporarily unavailable";

/// A fake compiler whose n-th call follows the n-th line: "good", or the message with which it
/// fails; calls after the last line succeed.
class PlayedCompiler {
 public:
  explicit PlayedCompiler(const std::vector<std::string>& calls) {
    std::string plan;
    for (const std::string& call : calls)
      plan += call + "\n";
    write_file(folder_.path() / "plan", plan);
    fs::copy_file(PLAYED_COMPILER, program());
    fs::create_directory(folder_.path() / "ours");
    fs::create_directory(folder_.path() / "theirs");
  }

  Compiled compile() const {
    LabTools tools;
    tools.recipe.compiler = program();
    tools.name_space = "lab01";
    tools.stubs = {{"x.cpp", "a stub"}};
    const Sandbox sandbox = Sandbox::at(Level::limits, {});
    return grader::compile({{"x.cpp", "a student's"}}, tools, sandbox,
                           {folder_.path() / "ours", folder_.path() / "theirs"},
                           folder_.path() / "worker");
  }

 private:
  fs::path program() const { return folder_.path() / "compiler"; }

  ScratchFolder folder_;
};

}  // namespace

TEST_CASE("what compiles is linked, with nothing in its favour", "[compile]") {
  const Compiled compiled = PlayedCompiler({"good", "good"}).compile();
  CHECK(compiled.linked);
  CHECK(compiled.messages.empty());
}

TEST_CASE("a file that fails, the stub not, and that fails again does not compile", "[compile]") {
  for (const std::string words :
       {"x.cpp:1:1: error: expected ';'", "x.cpp:1:2: error: #error No space left on device"}) {
    const Compiled compiled = PlayedCompiler({words, "good", words}).compile();
    CHECK_FALSE(compiled.linked);
    CHECK(compiled.refused == std::vector<std::string>{"x.cpp"});
    CHECK(compiled.messages == words + "\n");
  }
}

TEST_CASE("what fails once, for whatever reason, is no failure", "[compile]") {
  for (const char* words : {full_disk, no_process, "something", "x.cpp:1:1: error: so it seems"}) {
    INFO(words);
    CHECK(PlayedCompiler({words, "good", "good"}).compile().linked);
    CHECK(PlayedCompiler({"good", words, "good"}).compile().linked);  // at linking
  }
}

TEST_CASE("where the stub does not compile then, nothing is said of the file", "[compile]") {
  CHECK_THROWS_AS(PlayedCompiler({"something", "something"}).compile(), Error);
}

TEST_CASE("what the machine lacks each time is not the student's fault", "[compile]") {
  for (const std::string words : {full_disk, no_process}) {
    CHECK_THROWS_AS(PlayedCompiler({words, "good", words}).compile(), Error);
    CHECK_THROWS_AS(PlayedCompiler({"good", words, "good", "good", words}).compile(), Error);
  }
}
