// The header shared by all files of a lab, compiled once: with the real compiler.

#include "grader/grade/precompiled_header.h"

#include "course/cli/scratch_folder.h"
#include "grader/grade/compilation.h"
#include "support/atomic_file.h"

#include <catch2/catch_test_macros.hpp>

#include <filesystem>
#include <string>

using namespace carlo;
using namespace carlo::grader;
namespace fs = std::filesystem;

namespace {

/// A lab with so many files that begin with shared.h.
class SharedHeader {
 public:
  explicit SharedHeader(int files) {
    fs::create_directory(header_folder());
    fs::create_directory(folder_.path() / "theirs");
    write_header(
        "#pragma once\n#ifndef VALUE\n#define VALUE 1\n#endif\n"
        "constexpr int shared_value = VALUE;\n");
    tools.recipe.compiler = "/usr/bin/g++";
    tools.recipe.flags = {"-std=c++20"};
    tools.recipe.includes = tools.headers = {header_folder()};
    tools.name_space = "lab01";
    for (int i = 0; i < files; ++i)
      tools.stubs[std::to_string(i) + ".cpp"] = "#include <cstddef>\n#include \"shared.h\"\n";
  }

  void write_header(const std::string& text) const {
    write_file(header_folder() / "shared.h", text);
  }

  bool compiles(const std::string& text) const {
    const Sandbox sandbox = Sandbox::at(Level::limits, {});
    Compilation compilation(tools, sandbox, folder_.path() / "theirs");
    std::string messages;
    return compilation.make("x.cpp", text, folder_.path() / "x.o", messages);
  }

  LabTools tools;

 private:
  fs::path header_folder() const { return folder_.path() / "headers"; }

  ScratchFolder folder_;
};

}  // namespace

TEST_CASE("the header of a lab of many files is read once", "[compile]") {
  if (!fs::exists("/usr/bin/g++")) SKIP("it is g++'s");
  const SharedHeader lab(4);
  const std::string begin = "// of mine\n#include <cstddef>\n\n#include \"shared.h\"\n";
  REQUIRE(header_ahead(lab.tools, begin).empty());
  precompile(lab.tools);
  REQUIRE(header_ahead(lab.tools, begin) == "shared.h");
  CHECK(lab.compiles(begin + "static_assert(shared_value == 1);\n"));
  CHECK_FALSE(lab.compiles(begin + "static_assert(shared_value == 2);\n"));
  // Another version shows which one was read.
  lab.write_header("#pragma once\nconstexpr int other = 2;\n");
  CHECK(lab.compiles(begin + "static_assert(shared_value == 1 && other == 2);\n"));
}

TEST_CASE("a header is read where it stands where that may matter", "[compile]") {
  if (!fs::exists("/usr/bin/g++")) SKIP("it is g++'s");
  const SharedHeader lab(4);
  precompile(lab.tools);
  CHECK(
      lab.compiles("#define VALUE 2\n#include \"shared.h\"\nstatic_assert(shared_value == 2);\n"));
  CHECK_FALSE(lab.compiles("static_assert(shared_value == 1);\n"));
  lab.write_header("#pragma once\nconstexpr int other = 2;\n");
  for (const char* before :
       {"#define VALUE 2\n", "  #define VALUE 2\n", "/**/ #define VALUE 2\n", "int x;\n"}) {
    CAPTURE(before);
    const std::string text = std::string(before) + "#include \"shared.h\"\n";
    CHECK(lab.compiles(text + "static_assert(other == 2);\n"));
    CHECK_FALSE(lab.compiles(text + "static_assert(shared_value == 1);\n"));
  }
}

TEST_CASE("the header of a lab of few files is not read ahead", "[compile]") {
  if (!fs::exists("/usr/bin/g++")) SKIP("it is g++'s");
  const SharedHeader lab(1);
  precompile(lab.tools);
  CHECK(header_ahead(lab.tools, "#include \"shared.h\"\n").empty());
  CHECK(lab.compiles("#include \"shared.h\"\nstatic_assert(shared_value == 1);\n"));
}

TEST_CASE("a header that cannot be read ahead keeps nobody from compiling", "[compile]") {
  if (!fs::exists("/usr/bin/g++")) SKIP("it is g++'s");
  const SharedHeader lab(4);
  lab.write_header("#error not ahead\n");
  precompile(lab.tools);
  lab.write_header("#pragma once\nconstexpr int shared_value = 3;\n");
  precompile(lab.tools);  // once
  CHECK(header_ahead(lab.tools, "#include \"shared.h\"\n").empty());
  CHECK(lab.compiles("#include \"shared.h\"\nstatic_assert(shared_value == 3);\n"));
}
