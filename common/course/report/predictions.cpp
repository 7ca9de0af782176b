#include "course/report/predictions.h"

#include "course/guide/own_files.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "support/number.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <system_error>

namespace carlo {
namespace {

namespace fs = std::filesystem;

bool is_nothing(const JsonScalar& value) {
  return std::holds_alternative<std::monostate>(value);
}

bool same(const Cell& cell, const JsonScalar& wanted) {
  if (const auto* number = std::get_if<double>(&wanted)) return cell.value == *number;
  const auto* text = std::get_if<std::string>(&wanted);
  return text != nullptr && !cell.value && cell.text == *text;
}

/// Returns the row's cell in a column; null if the table has no such column.
const Cell* cell_in(const Table& table, const std::vector<Cell>& row, const std::string& column) {
  const std::vector<std::string>& keys = table.keys();
  const auto found = std::find(keys.begin(), keys.end(), column);
  return found == keys.end() ? nullptr : &row[static_cast<std::size_t>(found - keys.begin())];
}

bool fits(const Table& table, const std::vector<Cell>& row, const Where& wanted) {
  return std::all_of(wanted.begin(), wanted.end(), [&](const auto& column) {
    const Cell* cell = cell_in(table, row, column.first);
    return cell != nullptr && same(*cell, column.second);
  });
}

/// Returns the value in the last row that matches, if it is a finite number.
std::optional<double> value_at(const Table& table, const Where& wanted, const std::string& column) {
  std::optional<double> value;
  for (const std::vector<Cell>& row : table.rows()) {
    const Cell* cell = cell_in(table, row, column);
    if (cell != nullptr && fits(table, row, wanted)) value = cell->value;
  }
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<double> number_in(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  return number_of<double>(text);
}

/// Removes blanks, and replaces a typographic minus, which people copy, by "-".
std::string without_blanks(std::string_view typed) {
  constexpr std::string_view minus = "\u2212";
  std::string plain;
  while (!typed.empty()) {
    const bool copied = typed.substr(0, minus.size()) == minus;
    if (copied) {
      plain += '-';
    } else if (typed.front() != ' ' && typed.front() != '\t' && typed.front() != '\r') {
      plain += typed.front();
    }
    typed.remove_prefix(copied ? minus.size() : 1);
  }
  return plain;
}

/// Parses "-1/2", "2.5" or "95 %".
std::optional<double> value_in(std::string_view text) {
  const bool percent = !text.empty() && text.back() == '%';
  if (percent) text.remove_suffix(1);
  const std::size_t slash = text.find('/');
  std::optional<double> value = number_in(text.substr(0, slash));
  if (value && slash != std::string_view::npos) {
    const std::optional<double> below = number_in(text.substr(slash + 1));
    value = below && *below != 0 ? std::optional(*value / *below) : std::nullopt;
  }
  if (!value || !std::isfinite(*value)) return std::nullopt;
  return percent ? *value / 100 : *value;
}

/// "predict" in lab.json.
struct Predict {
  Question question;
};

void fields(JsonFields& json, Predict& predict) {
  Question& question = predict.question;
  std::string kind;
  json("question", question.text);
  json("kind", kind);
  json("experiment", question.experiment);
  if (json.has("row")) json("row", question.row);
  if (kind == "choice") {
    json("choices", question.choices);
    json("name", question.name);
    question.largest = json.has("largest");
    if (question.choices.size() < 2) json.fail("\"choices\" needs two at least");
    if (question.largest == json.has("smallest")) {
      json.fail("needs \"largest\" or \"smallest\"");
    }
    json(question.largest ? "largest" : "smallest", question.column);
  } else if (kind == "number" || kind == "share") {
    json("value", question.column);
    json("over", question.over);
    question.share = kind == "share";
  } else {
    json.fail("\"kind\" must be number, share or choice");
  }
}

/// What else lab.json says of an exercise, the guide reads (guide/exercises.h).
struct Entry {
  std::optional<Predict> predict;
};

void fields(JsonFields& json, Entry& entry) {
  json("predict", entry.predict);
}

struct Entries {
  std::vector<Entry> exercises;
};

void fields(JsonFields& json, Entries& entries) {
  json("exercises", entries.exercises);
}

struct Kept {
  std::map<std::string, JsonScalar> predictions;
};

void fields(JsonFields& json, Kept& kept) {
  json.all(kept.predictions);
}

/// Describes what may be typed.
std::string wanted(const Question& question) {
  if (question.share) return "a share, such as 30 % or .3";
  if (question.choices.empty()) return "a number, such as 2.5 or 1/3";
  return fmt::format("a number from 1 to {}", question.choices.size());
}

/// `enter`: the effect of an empty line.
std::string prompt(const Question& question, const std::string& enter) {
  std::string text =
      fmt::format("\nPredict first (Lab {}): {}\n", question.exercise, question.text);
  for (std::size_t i = 0; i < question.choices.size(); ++i)
    text += fmt::format("  {} {}\n", i + 1, question.choices[i]);
  return text + fmt::format("{} ({}): ", wanted(question), enter);
}

}  // namespace

JsonScalar Question::answer(const Results& results) const {
  const auto found = results.tables.find(experiment);
  if (found == results.tables.end()) return {};
  const Table& table = found->second;
  if (choices.empty()) {
    const std::optional<double> value = value_at(table, row, column);
    const std::optional<double> base = over ? value_at(table, *over, column) : 1;
    if (!value || !base || *base == 0) return {};
    return *value / *base;
  }
  std::optional<double> best;
  JsonScalar answer;
  for (const std::string& choice : choices) {
    Where wanted = row;
    wanted[name] = choice;
    const std::optional<double> value = value_at(table, wanted, column);
    if (!value) return {};  // all choices or none
    if (best && !(largest ? *value > *best : *value < *best)) continue;
    best = value;
    answer = choice;
  }
  return answer;
}

JsonScalar Question::read(const std::string& typed) const {
  const std::string plain = without_blanks(typed);
  std::optional<double> value = value_in(plain);
  if (!value) return {};
  if (share) {
    // The percent sign may be omitted; 1 and less is the share itself.
    if (plain.back() != '%' && *value > 1) *value /= 100;
    return *value >= 0 && *value <= 1 ? JsonScalar(*value) : JsonScalar();
  }
  if (plain.back() == '%') return {};  // percent of what?
  if (choices.empty()) return *value;
  const auto last = static_cast<double>(choices.size());
  if (*value < 1 || *value > last || std::floor(*value) != *value) return {};
  return choices[static_cast<std::size_t>(*value) - 1];
}

std::string Question::shown(const JsonScalar& value) const {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr) return "";
  return share ? fmt::format("{:.3g} %", 100 * *number) : fmt::format("{:.3g}", *number);
}

Predictions::Predictions(const fs::path& root, int number)
    : file_(root / ".carlo/predictions.json") {
  const fs::path labs = file_.parent_path().parent_path() / "labs";
  for (const Lab& lab : load_labs(labs)) {
    if (lab.number != number) continue;
    const OwnCode code(labs, lab);
    const fs::path file = labs / fmt::format("{:02}_{}", lab.number, lab.name) / "lab.json";
    auto entries = from_json_text<Entries>(read_file(file), file.string()).exercises;
    for (std::size_t i = 0; i < lab.exercises.size(); ++i) {
      const Exercise& exercise = lab.exercises[i];
      if (std::optional<Predict>& predict = entries.at(i).predict) {
        predict->question.exercise = exercise.number();
        questions_.push_back(predict->question);
      }
      if (code.open_functions(exercise) == 0) written_.push_back(exercise.number());
    }
  }
  if (!fs::exists(file_)) return;
  try {
    kept_ = from_json_text<Kept>(read_file(file_), file_.string()).predictions;
  } catch (const Error&) {
    throw Error("{}: not a record of predictions; remove it to start afresh", file_.string());
  }
}

void Predictions::ask(const std::function<void(const std::string&)>& say,
                      const std::function<std::optional<std::string>()>& hear, bool again) {
  for (const Question& question : questions_) {
    const bool can_run =
        std::find(written_.begin(), written_.end(), question.exercise) != written_.end();
    if (!can_run || (kept_.contains(question.exercise) && !again)) continue;
    const auto before = kept_.find(question.exercise);
    JsonScalar kept = before == kept_.end() ? JsonScalar() : before->second;
    const std::string enter =
        is_nothing(kept) ? "Enter skips" : "Enter leaves it at " + question.shown(kept);
    say(prompt(question, enter));
    while (true) {
      const std::optional<std::string> typed = hear();
      if (!typed) return;
      if (typed->find_first_not_of(" \t\r") == std::string::npos) break;
      const JsonScalar read = question.read(*typed);
      if (!is_nothing(read)) {
        kept = read;
        break;
      }
      say(fmt::format("\"{}\" is not {} ({}): ", *typed, wanted(question), enter));
    }
    kept_[question.exercise] = kept;
    save();
  }
}

void Predictions::save() const {
  std::error_code ec;
  fs::create_directories(file_.parent_path(), ec);
  write_file(file_, json_text(Kept{kept_}, 2) + "\n");
}

Table Predictions::table(const Results& results) const {
  Table table({"exercise", "you predicted", "this run", "question"},
              {"exercise", "predicted", "result", "question"});
  for (const Question& question : questions_) {
    const auto kept = kept_.find(question.exercise);
    const JsonScalar result = question.answer(results);
    // Of the same kind: the question may have been another one when it was answered.
    if (is_nothing(result) || kept == kept_.end() || kept->second.index() != result.index())
      continue;
    const auto cell = [&](const JsonScalar& value) {
      const std::string text = question.shown(value);
      const auto* number = std::get_if<double>(&value);
      return number != nullptr ? Cell(text, *number) : Cell(text);
    };
    table.add_row({question.exercise, cell(kept->second), cell(result), question.text});
  }
  return table;
}

}  // namespace carlo
