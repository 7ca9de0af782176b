#include "course/cli/scratch_folder.h"
#include "grader/grade/handed_in.h"
#include "grader/grade/packed.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace fs = std::filesystem;
using namespace carlo;
using namespace carlo::grader;

TEST_CASE("one submission or many is seen from what stands at the top", "[intake]") {
  const ScratchFolder folder;
  const fs::path& root = folder.path();
  put(root / "class/alice/integration.cpp", "a");
  put(root / "class/bob.zip", zip({{"integration.cpp", "b"}}));
  put(root / "class/carol/hw.zip", zip({{"integration.cpp", "c"}}));
  put(root / "class/notes.txt", "");
  CHECK(submission_names(root / "class") == std::vector<std::string>{"alice", "bob", "carol"});
  CHECK(submission_names(root / "class/alice") == std::vector<std::string>{"alice"});
  CHECK(submission_names(root / "class/bob.zip") == std::vector<std::string>{"bob"});
  CHECK(submission_names(root / "class", true) == std::vector<std::string>{"class"});
  CHECK_THROWS_AS(submission_names(root / "class/notes.txt"), Error);
  CHECK_THROWS_AS(submission_names(root / "nowhere"), Error);

  put(root / "wrapped.zip", zip({{"hw/labs/01_integration/integration.cpp", "x"}}));
  CHECK(submission_names(root / "wrapped.zip") == std::vector<std::string>{"wrapped"});
  put(root / "export.zip", zip({{"all/dora/integration.cpp", "d"}, {"all/emil.zip", "PK"}}));
  CHECK(submission_names(root / "export.zip") == std::vector<std::string>{"dora", "emil"});
  const Source dora = find_submissions({root / "export.zip"}, demo_labs(), false).sources[0];
  CHECK(take_in(dora, demo_labs()).labs.at(1).files.at("integration.cpp") == "d");
}

TEST_CASE("what one packed into a class's archive is no matter of the others", "[intake]") {
  const ScratchFolder folder;
  std::vector<Entry> entries{{"alice/integration.cpp", "a"}};
  for (int i = 0; i < 20'001; ++i)
    entries.push_back({"bob/" + std::to_string(i), ""});
  entries.push_back({"carol/integration.cpp", "c"});
  put(folder.path() / "export.zip", zip(entries));
  const std::vector<Source> found =
      find_submissions({folder.path() / "export.zip"}, demo_labs(), false).sources;
  REQUIRE(found.size() == 3);
  CHECK(take_in(found[0], demo_labs()).labs.at(1).files.at("integration.cpp") == "a");
  CHECK(take_in(found[1], demo_labs()).labs.at(1).files.empty());
  CHECK(take_in(found[2], demo_labs()).labs.at(1).files.at("integration.cpp") == "c");
}

TEST_CASE("names of submissions are harmless, and no two are the same", "[intake]") {
  std::vector<std::string> taken{"secret"};
  CHECK(folder_name("Alice Smith_12", taken) == "Alice_Smith_12");
  CHECK(folder_name("Alice/Smith_12", taken) == "Alice_Smith_12-2");
  CHECK(folder_name("..", taken) == "unnamed");
  CHECK(folder_name("=HYPERLINK(\"x\"),\n", taken) == "_HYPERLINK__x____");
  CHECK(folder_name("J\xC3\xB6rg", taken) == "J\xC3\xB6rg");
  CHECK(folder_name("J\xC3", taken) == "J_");
  // U+202E, right-to-left override, as bytes: a linter mistakes the escape for the character.
  const std::string reversed{'a', '\xE2', '\x80', '\xAE', 'b'};
  CHECK(folder_name(reversed, taken) == "a___b");
  CHECK(folder_name("\xEF\xBC\x9D"
                    "cmd",
                    taken) == "___cmd");  // a fullwidth equals sign
  CHECK(folder_name("secret", taken) == "secret-2");
  CHECK(folder_name(std::string(300, 'a'), taken).size() == 100);
}

TEST_CASE("no submission stands in the place of a file of the class", "[intake]") {
  for (const char* name :
       {"class.csv", "class.html", "secret", "similarity.csv", "similarity.html", "timing.csv"}) {
    const ScratchFolder folder;
    put(folder.path() / name / "integration.cpp", "a");
    put(folder.path() / "alice" / "integration.cpp", "b");
    const std::vector<Source> found = find_submissions({folder.path()}, demo_labs(), false).sources;
    REQUIRE(found.size() == 2);
    CHECK(found[1].name == std::string(name) + "-2");
    CHECK(found[1].renamed);
  }
}

TEST_CASE("a name is whose own it is, and others are told of", "[intake]") {
  const ScratchFolder folder;
  for (const char* name : {"a b", "a-b", "a_b", "alice"})
    put(folder.path() / name / "integration.cpp", name);
  put(folder.path() / "alice.tar.gz", "spoilt");
  put(folder.path() / "alice.zip", "spoilt");
  std::map<std::string, std::pair<std::string, bool>> names;
  for (const Source& source : find_submissions({folder.path()}, demo_labs(), false).sources)
    names[source.handed_in()] = {source.name, source.renamed};
  const auto of = [](const std::string& name, bool renamed) { return std::pair(name, renamed); };
  CHECK(names.at("a_b") == of("a_b", false));
  CHECK(names.at("a-b") == of("a-b", false));
  CHECK(names.at("a b") == of("a_b-2", true));
  CHECK(names.at("alice") == of("alice", false));
  CHECK(names.at("alice.tar.gz") == of("alice-2", true));
  CHECK(names.at("alice.zip") == of("alice-3", true));
}
