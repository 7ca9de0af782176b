#pragma once

#include "course/report/table.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// What an exercise asks before its experiment is seen ("predict" in lab.json), and where in a
/// run's tables the answer stands:
///   {"question": "...", "kind": "number", "experiment": TABLE, "row": {COLUMN: VALUE, ...},
///    "value": COLUMN, "over": {COLUMN: VALUE, ...}}
/// the value of the last row that fits, divided by that of the row `over` where it is given; of
/// kind "share" the same, a value from 0 to 1 that people see and type as a percentage; or
///   {"question": "...", "kind": "choice", "choices": ["...", ...], "experiment": TABLE,
///    "name": COLUMN, "largest" or "smallest": COLUMN, "row": {...}}
/// the name in the row, among those whose name is a choice, where that column is extreme.
struct Question {
  std::string exercise;  ///< "1.1"
  std::string text;
  std::vector<std::string> choices;  ///< none: a number is asked for
  bool share = false;                ///< of the number: from 0 to 1, for people in percent
  nlohmann::json where;              ///< the object above

  /// What a run's tables (Notebook::results()) say; none when the experiment was left out. Numbers
  /// as numbers, choices as text.
  nlohmann::json answer(const nlohmann::json& tables) const;

  /// What somebody typed: a number such as -0.5 or -1/2 or 50 %, or a choice's number from 1. Of a
  /// share, 95 and .95 are 95 % too. Null when it is neither, or no share.
  nlohmann::json read(const std::string& typed) const;

  /// An answer, or what was read, for people.
  std::string shown(const nlohmann::json& value) const;
};

/// The predictions of one lab: asked for once, kept, and shown beside what the run gave.
class Predictions {
 public:
  /// Of lab `number` of the tree `root`; kept in root/.carlo/predictions.json. Throws Error when
  /// lab.json asks what is no such question, or the file is something else.
  Predictions(const std::filesystem::path& root, int number);

  /// Asks those that have no answer yet (`again`: all) and whose exercise is written: `say` prints
  /// a text, `hear` gives the line that was typed, or nothing at the input's end. An empty line
  /// leaves what was predicted before, or skips a question until it is asked again.
  void ask(const std::function<void(const std::string&)>& say,
           const std::function<std::optional<std::string>()>& hear, bool again = false);

  /// Prediction beside result, for those that have both; no rows when there are none.
  Table table(const nlohmann::json& tables) const;

 private:
  void save() const;

  std::filesystem::path file_;
  std::vector<Question> questions_;
  std::vector<std::string> written_;  ///< exercises that can be run
  nlohmann::json kept_ = nlohmann::json::object();
};

}  // namespace carlo
