#pragma once

#include "course/json/json_fields.h"
#include "course/report/results.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// Which rows of a table: the values of some columns.
using Where = std::map<std::string, JsonScalar>;

/// A question that an exercise asks before its experiment is seen ("predict" in lab.json), and
/// where the answer is in a run's tables:
///   {"question": "...", "kind": "number", "experiment": TABLE, "row": {COLUMN: VALUE, ...},
///    "value": COLUMN, "over": {COLUMN: VALUE, ...}}
/// the value in the last row that matches, divided by that of the row `over` if it is given; kind
/// "share" is the same, a value from 0 to 1 that people see and type as a percentage; or
///   {"question": "...", "kind": "choice", "choices": ["...", ...], "experiment": TABLE,
///    "name": COLUMN, "largest" or "smallest": COLUMN, "row": {...}}
/// the name in the row where that column is extreme, among rows whose name is a choice.
struct Question {
  std::string exercise;  ///< "1.1"
  std::string text;
  std::vector<std::string> choices;  ///< if empty, a number is asked for
  bool share = false;                ///< the number is from 0 to 1, shown to people as a percentage
  std::string experiment;            ///< the table
  Where row;
  std::optional<Where> over;
  std::string column;  ///< of the value, or the one that is extreme
  std::string name;    ///< the column of the choices
  bool largest = false;

  /// Returns the answer in a run's tables; nothing if the experiment was left out. Numbers as
  /// numbers, choices as text.
  JsonScalar answer(const Results& results) const;

  /// Parses what somebody typed: a number such as -0.5 or -1/2 or 50 %, or a choice's number from
  /// 1. For a share, 95 and .95 also mean 95 %. Nothing if it is neither, or no share.
  JsonScalar read(const std::string& typed) const;

  /// Formats an answer, or what was read, for people; "" for nothing.
  std::string shown(const JsonScalar& value) const;
};

/// The predictions of one lab: asked for once, kept, and shown next to the results of the run.
class Predictions {
 public:
  /// For lab `number` of the tree `root`; kept in root/.carlo/predictions.json. Throws Error if
  /// lab.json has an invalid question, or the file is something else.
  Predictions(const std::filesystem::path& root, int number);

  /// Asks the questions that have no answer yet (`again`: all) and whose exercise is written: `say`
  /// prints a text, `hear` returns the line that was typed, or nothing at the end of input. An
  /// empty line keeps the previous prediction, or skips a question until it is asked again.
  void ask(const std::function<void(const std::string&)>& say,
           const std::function<std::optional<std::string>()>& hear, bool again = false);

  /// Returns predictions next to results, for questions that have both; no rows if there are none.
  Table table(const Results& results) const;

 private:
  void save() const;

  std::filesystem::path file_;
  std::vector<Question> questions_;
  std::vector<std::string> written_;        ///< exercises that can be run
  std::map<std::string, JsonScalar> kept_;  ///< by exercise; nothing if it was skipped
};

}  // namespace carlo
