#include "course/report/predictions.h"

#include "support/atomic_file.h"
#include "support/error.h"
#include "texts.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using namespace carlo;

namespace {

constexpr const char* exercises = R"([
  {"tag": "Lab 1.1", "title": "First", "points": 2, "functions": ["f"],
   "hints": ["nudge", "plan"],
   "predict": {"question": "Which slope?", "kind": "number", "experiment": "slopes",
               "row": {"method": "dice"}, "value": "slope"}},
  {"tag": "Lab 1.2", "title": "Second", "points": 3, "functions": ["g"],
   "hints": ["nudge", "plan"],
   "predict": {"question": "Which is worst?", "kind": "choice", "choices": ["dice", "rule"],
               "experiment": "slopes", "name": "method", "largest": "error"}}])";

/// A tree with one lab, in which Lab 1.1 is solved.
class PredictionTree {
 public:
  explicit PredictionTree(const std::string& list = exercises)
      : root_(fs::temp_directory_path() / fmt::format("carlo_predict_{}", ::getpid())) {
    fs::create_directories(root_ / "labs/01_demo");
    write_file(root_ / "labs/01_demo/lab.json",
               R"({"lab": 1, "name": "demo", "title": "Demo", "exercises": )" + list + "}");
    write_file(root_ / "labs/01_demo/demo.cpp", "not_implemented(\"Lab 1.2\", \"L\");\n");
  }
  ~PredictionTree() {
    std::error_code ec;
    fs::remove_all(root_, ec);
  }
  PredictionTree(const PredictionTree&) = delete;
  PredictionTree& operator=(const PredictionTree&) = delete;
  const fs::path& root() const { return root_; }
  void finish() const { write_file(root_ / "labs/01_demo/demo.cpp", "done\n"); }

 private:
  fs::path root_;
};

/// The output while these lines were typed.
std::string asked(Predictions& predictions, std::vector<std::string> lines, bool again = false) {
  std::string said;
  predictions.ask([&](const std::string& text) { said += text; },
                  [&]() -> std::optional<std::string> {
                    if (lines.empty()) return std::nullopt;
                    std::string line = lines.front();
                    lines.erase(lines.begin());
                    return line;
                  },
                  again);
  return said;
}

Results some_results() {
  Table slopes({"method", "slope", "error"});
  slopes.add_row({"dice", -1.0, 0.25});
  slopes.add_row({"rule", -2.0, 0.5});
  slopes.add_row({"dice", -0.5, 0.25});
  return {{{"slopes", slopes}}};
}

/// Column `column` of a row of what was predicted.
const Cell& cell(const Table& table, std::size_t row, const std::string& column) {
  const auto& keys = table.keys();
  const auto found = std::find(keys.begin(), keys.end(), column);
  REQUIRE(found != keys.end());
  return table.rows().at(row).at(static_cast<std::size_t>(found - keys.begin()));
}

}  // namespace

TEST_CASE("a prediction is asked for once, of what is written, and shown beside the result",
          "[predictions]") {
  const PredictionTree tree;
  {
    Predictions predictions(tree.root(), 1);
    const std::string said = asked(predictions, {"steep", "-1/3"});
    CHECK(has(said, "Which slope?"));
    CHECK(has(said, "\"steep\" is not a number, such as"));
    CHECK_FALSE(has(said, "Which is worst?"));
  }
  Predictions again(tree.root(), 1);
  CHECK(asked(again, {"7"}).empty());
  const Table shown = again.table(some_results());
  REQUIRE(shown.rows().size() == 1);
  CHECK(cell(shown, 0, "predicted").value == -1.0 / 3);
  CHECK(cell(shown, 0, "result").value == -0.5);  // the last row that fits
  tree.finish();
  Predictions later(tree.root(), 1);
  CHECK(has(asked(later, {"3", "1"}), "a number from 1 to 2"));
  const Table both = later.table(some_results());
  REQUIRE(both.rows().size() == 2);
  CHECK(cell(both, 1, "predicted").text == "dice");
  CHECK(cell(both, 1, "result").text == "rule");
}

TEST_CASE("Enter skips a question for good; the input's end only for now", "[predictions]") {
  const PredictionTree tree;
  {
    Predictions predictions(tree.root(), 1);
    CHECK(has(asked(predictions, {}), "Which slope?"));
    CHECK(has(asked(predictions, {""}), "Which slope?"));
  }
  Predictions again(tree.root(), 1);
  CHECK(asked(again, {"1"}).empty());
  CHECK(again.table(some_results()).rows().empty());
}

TEST_CASE("experiments that were left out have no result", "[predictions]") {
  const PredictionTree tree;
  Predictions predictions(tree.root(), 1);
  (void)asked(predictions, {"-0.5"});
  CHECK(predictions.table({}).rows().empty());
  CHECK(predictions.table({{{"slopes", Table({"method"})}}}).rows().empty());
}

TEST_CASE("numbers as people type them; a ratio of two rows", "[predictions]") {
  Question question;
  question.experiment = "slopes";
  question.row["method"] = "rule";
  question.over.emplace()["method"] = "dice";
  question.column = "error";
  CHECK(question.answer(some_results()) == JsonScalar(2.0));
  CHECK(question.read(" -1/2 ") == JsonScalar(-0.5));
  CHECK(question.read("\u22121.5e1") == JsonScalar(-15.0));
  CHECK(question.read("+3") == JsonScalar(3.0));
  for (const char* no : {"", "x", "1/0", "1/", "1 or 2", "nan", "inf", "%", "3 %%", "95 %"})
    CHECK(question.read(no) == JsonScalar());
}

TEST_CASE("a share is typed with or without its percent sign, and shown with it", "[predictions]") {
  Question question;
  question.share = true;
  for (const char* typed : {"95 %", "95%", ".95", "0.95", "95", "+95 %", "19/20"})
    CHECK(question.read(typed) == JsonScalar(0.95));
  CHECK(question.read("1 %") == JsonScalar(0.01));
  CHECK(question.read("0.5 %") == JsonScalar(0.005));
  CHECK(question.read("1") == JsonScalar(1.0));
  CHECK(question.read("100") == JsonScalar(1.0));
  for (const char* no : {"-5 %", "101 %", "250", "many", "%"})
    CHECK(question.read(no) == JsonScalar());
  CHECK(question.shown(0.95) == "95 %");
  CHECK(question.shown(1.0 / 3) == "33.3 %");
}

TEST_CASE("asked again, Enter leaves what was predicted before", "[predictions]") {
  const PredictionTree tree;
  {
    Predictions predictions(tree.root(), 1);
    (void)asked(predictions, {"-1"});
    const std::string said = asked(predictions, {""}, true);
    CHECK(has(said, "Which slope?"));
    CHECK(has(said, "Enter leaves it at -1"));
  }
  Predictions later(tree.root(), 1);
  CHECK(cell(later.table(some_results()), 0, "predicted").value == -1.0);
  CHECK(has(asked(later, {"-1/2"}, true), "Which slope?"));
  CHECK(cell(later.table(some_results()), 0, "predicted").value == -0.5);
}

TEST_CASE("a question that lab.json asks badly is an error that names the exercise",
          "[predictions]") {
  std::string list = exercises;
  list.replace(list.find("\"largest\""), 9, "\"highest\"");
  const PredictionTree tree(list);
  CHECK_THROWS_AS(Predictions(tree.root(), 1), Error);
}
