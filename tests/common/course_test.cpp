#include "course/guide/exercises.h"
#include "course/guide/hints.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "texts.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers.hpp>
#include <fmt/core.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace fs = std::filesystem;
using namespace carlo;

namespace {

/// A temporary folder, removed when the test ends.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / fmt::format("carlo_course_{}", ::getpid())) {
    fs::create_directories(path_ / "labs/01_demo");
  }
  ~Folder() {
    std::error_code ec;
    fs::remove_all(path_, ec);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path labs() const { return path_ / "labs"; }
  fs::path state() const { return path_ / ".carlo/state.json"; }
  void write_lab(const std::string& text) const { write_file(labs() / "01_demo/lab.json", text); }

 private:
  fs::path path_;
};

std::string exercise(const std::string& tag, const std::string& points = "2") {
  return fmt::format(
      R"({{"tag": "{}", "title": "T", "points": {}, "functions": ["f"],
          "hints": ["nudge", "plan"]}})",
      tag, points);
}

std::string lab_json(const std::string& exercises) {
  return R"({"lab": 1, "name": "demo", "title": "Demo", "exercises": [)" + exercises + "]}";
}

std::string error_of(const Folder& folder, const std::string& text) {
  folder.write_lab(text);
  try {
    load_labs(folder.labs());
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("a lab's exercises are read in order", "[course]") {
  const Folder folder;
  folder.write_lab(lab_json(exercise("Lab 1.1") + "," + exercise("Lab 1.2", "3")));
  const std::vector<Lab> labs = load_labs(folder.labs());
  REQUIRE(labs.size() == 1);
  CHECK(labs[0].points() == 5);
  REQUIRE(labs[0].find("Lab 1.2") != nullptr);
  CHECK(labs[0].find("Lab 1.2")->number() == "1.2");
  CHECK(labs[0].find("Lab 1.3") == nullptr);
  CHECK(&find_lab(labs, 1) == &labs[0]);
  CHECK_THROWS_WITH(find_lab(labs, 9), "there is no lab 9; there are: 1");
}

TEST_CASE("a broken lab.json is one line that says where and what", "[course]") {
  const Folder folder;
  CHECK(has(error_of(folder, "{"), "lab.json: not valid JSON"));
  CHECK(has(error_of(folder, "[]"), "expected an object"));
  CHECK(has(error_of(folder, "{}"), "\"lab\" is missing"));
  CHECK(has(error_of(folder, lab_json("")), "no exercises"));
  CHECK(has(error_of(folder, lab_json(exercise("Lab 1.2"))), "expected \"Lab 1.1\""));
  CHECK(has(error_of(folder, lab_json(exercise("Lab 1.1", "0"))), "\"points\" must be"));
  CHECK(has(error_of(folder, lab_json(exercise("Lab 1.1", "1.5"))), "\"points\" must be"));
  CHECK(has(error_of(folder, lab_json(exercise(""))), "\"tag\" must be"));
  CHECK_THROWS_AS(load_labs(folder.labs() / "none"), Error);
}

TEST_CASE("hints come one at a time and are remembered", "[course]") {
  const Folder folder;
  folder.write_lab(lab_json(exercise("Lab 1.1")));
  const std::vector<Lab> labs = load_labs(folder.labs());
  const auto next = [&] {
    HintState state(folder.state());
    return hint_text(next_hint(find_exercise(labs, "1.1"), state));
  };
  const std::string first = next();
  CHECK(has(first, "hint 1 of 2; run again for the next"));
  CHECK(has(first, "nudge"));
  CHECK_FALSE(has(first, "plan"));
  CHECK(has(next(), "hint 2 of 2; the last\n\nplan"));
  CHECK(has(next(), "there are no more"));
}

TEST_CASE("hints that were seen are shown again, others are not", "[course]") {
  const Folder folder;
  folder.write_lab(lab_json(exercise("Lab 1.1")));
  const Exercise shown = load_labs(folder.labs())[0].exercises[0];
  HintState state(folder.state());
  CHECK_THROWS_AS(seen_hints(shown, state), Error);
  CHECK_THROWS_AS(seen_hint(shown, 1, state), Error);
  next_hint(shown, state);
  CHECK(has(hint_text(seen_hint(shown, 1, state)), "nudge"));
  CHECK(has(hint_text(seen_hints(shown, state)), "nudge"));
  CHECK_FALSE(has(hint_text(seen_hints(shown, state)), "plan"));
  for (const int number : {-1, 0, 2, 3})
    CHECK_THROWS_AS(seen_hint(shown, number, state), Error);
  CHECK(state.seen(shown) == 1);
  next_hint(shown, state);
  CHECK(has(hint_text(seen_hints(shown, state)), "nudge"));
  CHECK(has(hint_text(seen_hints(shown, state)), "plan"));
}

TEST_CASE("an exercise builds on earlier ones only", "[course]") {
  const Folder folder;
  const auto using_exercise = [](const std::string& tag, const std::string& used) {
    std::string text = exercise(tag);
    return text.insert(1, fmt::format(R"("uses": ["{}"], )", used));
  };
  const std::string first = exercise("Lab 1.1") + ",";
  folder.write_lab(lab_json(first + using_exercise("Lab 1.2", "Lab 1.1")));
  CHECK(load_labs(folder.labs())[0].exercises[1].uses == std::vector<std::string>{"Lab 1.1"});
  for (const char* wrong : {"Lab 1.2", "Lab 1.3", "1.1"}) {
    CHECK(has(error_of(folder, lab_json(first + using_exercise("Lab 1.2", wrong))),
              "no earlier exercise"));
  }
}

TEST_CASE("a wrong exercise number lists the right ones", "[course]") {
  const Folder folder;
  folder.write_lab(lab_json(exercise("Lab 1.1") + "," + exercise("Lab 1.2")));
  const std::vector<Lab> labs = load_labs(folder.labs());
  CHECK(find_exercise(labs, "Lab 1.2").tag == "Lab 1.2");
  CHECK_THROWS_WITH(find_exercise(labs, "1.9"), "there is no exercise 1.9; lab 1 has 1.1 to 1.2");
  CHECK_THROWS_WITH(find_exercise(labs, "1"), "which exercise of lab 1? There are 1.1 to 1.2");
  CHECK_THROWS_WITH(find_exercise(labs, "9.1"), "there is no lab 9; there are: 1");
  for (const char* wrong : {"", "one"})
    CHECK_THROWS_AS(find_exercise(labs, wrong), Error);
}

TEST_CASE("a spoilt record of hints is an error that says what to do", "[course]") {
  const Folder folder;
  fs::create_directories(folder.state().parent_path());
  for (const char* text : {"", "[]", R"({"hints": 3})"}) {
    write_file(folder.state(), text);
    CHECK_THROWS_AS(HintState(folder.state()), Error);
  }
}
