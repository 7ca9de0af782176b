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
using nlohmann::json;

bool same(const json& cell, const json& wanted) {
  if (!wanted.is_number()) return cell == wanted;
  return cell.is_number() && cell.get<double>() == wanted.get<double>();
}

bool fits(const json& row, const json& wanted) {
  return std::all_of(wanted.items().begin(), wanted.items().end(), [&](const auto& column) {
    return row.contains(column.key()) && same(row.at(column.key()), column.value());
  });
}

/// Returns the value in the last row that matches; null if there is none.
json value_at(const json& rows, const json& wanted, const std::string& column) {
  json value;
  for (const json& row : rows) {
    if (fits(row, wanted) && row.contains(column)) value = row.at(column);
  }
  return value.is_number() ? value : json();
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

Question question_of(const Exercise& exercise, const json& where) {
  const auto fail = [&](const char* what) {
    throw Error("{}: \"predict\" in lab.json {}", exercise.tag, what);
  };
  try {
    Question question;
    question.exercise = exercise.number();
    question.text = where.at("question").get<std::string>();
    question.where = where;
    (void)where.at("experiment").get<std::string>();
    if (!where.contains("row")) question.where["row"] = json::object();
    const auto kind = where.at("kind").get<std::string>();
    if (kind == "choice") {
      question.choices = where.at("choices").get<std::vector<std::string>>();
      (void)where.at("name").get<std::string>();
      if (question.choices.size() < 2) fail("needs two choices at least");
      if (where.contains("largest") == where.contains("smallest")) {
        fail("needs \"largest\" or \"smallest\"");
      }
    } else if (kind == "number" || kind == "share") {
      (void)where.at("value").get<std::string>();
      question.share = kind == "share";
    } else {
      fail("must be of kind number, share or choice");
    }
    return question;
  } catch (const json::exception&) {
    fail("lacks a field, or one is of a wrong type");
  }
  return {};
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

json Question::answer(const json& tables) const {
  const auto table = tables.find(where.at("experiment").get<std::string>());
  if (table == tables.end()) return {};
  if (choices.empty()) {
    const auto column = where.at("value").get<std::string>();
    json value = value_at(*table, where.at("row"), column);
    if (!where.contains("over") || value.is_null()) return value;
    const json base = value_at(*table, where.at("over"), column);
    if (base.is_null() || base.get<double>() == 0) return {};
    return value.get<double>() / base.get<double>();
  }
  const bool largest = where.contains("largest");
  const auto column = where.at(largest ? "largest" : "smallest").get<std::string>();
  json best, name;
  for (const std::string& choice : choices) {
    json wanted = where.at("row");
    wanted[where.at("name").get<std::string>()] = choice;
    const json value = value_at(*table, wanted, column);
    if (value.is_null()) return {};  // all choices or none
    const bool better = best.is_null() || (largest ? value > best : value < best);
    if (!better) continue;
    best = value;
    name = choice;
  }
  return name;
}

json Question::read(const std::string& typed) const {
  const std::string plain = without_blanks(typed);
  std::optional<double> value = value_in(plain);
  if (!value) return {};
  if (share) {
    // The percent sign may be omitted; 1 and less is the share itself.
    if (plain.back() != '%' && *value > 1) *value /= 100;
    return *value >= 0 && *value <= 1 ? json(*value) : json();
  }
  if (plain.back() == '%') return {};  // percent of what?
  if (choices.empty()) return *value;
  const auto last = static_cast<double>(choices.size());
  if (*value < 1 || *value > last || std::floor(*value) != *value) return {};
  return choices[static_cast<std::size_t>(*value) - 1];
}

std::string Question::shown(const json& value) const {
  if (!value.is_number()) return value.get<std::string>();
  return share ? fmt::format("{:.3g} %", 100 * value.get<double>())
               : fmt::format("{:.3g}", value.get<double>());
}

Predictions::Predictions(const fs::path& root, int number)
    : file_(root / ".carlo/predictions.json") {
  const fs::path labs = file_.parent_path().parent_path() / "labs";
  for (const Lab& lab : load_labs(labs)) {
    if (lab.number != number) continue;
    const OwnCode code(labs, lab);
    const json document =
        json::parse(read_file(labs / fmt::format("{:02}_{}", lab.number, lab.name) / "lab.json"));
    for (std::size_t i = 0; i < lab.exercises.size(); ++i) {
      const json& entry = document.at("exercises").at(i);
      const Exercise& exercise = lab.exercises[i];
      if (entry.contains("predict")) {
        questions_.push_back(question_of(exercise, entry.at("predict")));
      }
      if (code.open_functions(exercise) == 0) written_.push_back(exercise.number());
    }
  }
  if (!fs::exists(file_)) return;
  kept_ = json::parse(read_file(file_), nullptr, false);
  if (!kept_.is_object()) {
    throw Error("{}: not a record of predictions; remove it to start afresh", file_.string());
  }
}

void Predictions::ask(const std::function<void(const std::string&)>& say,
                      const std::function<std::optional<std::string>()>& hear, bool again) {
  for (const Question& question : questions_) {
    const bool can_run =
        std::find(written_.begin(), written_.end(), question.exercise) != written_.end();
    const json before = kept_.value(question.exercise, json());
    if (!can_run || (kept_.contains(question.exercise) && !again)) continue;
    const std::string enter =
        before.is_null() ? "Enter skips" : "Enter leaves it at " + question.shown(before);
    say(prompt(question, enter));
    json read;
    while (true) {
      const std::optional<std::string> typed = hear();
      if (!typed) return;
      if (typed->find_first_not_of(" \t\r") == std::string::npos) break;
      read = question.read(*typed);
      if (!read.is_null()) break;
      say(fmt::format("\"{}\" is not {} ({}): ", *typed, wanted(question), enter));
    }
    kept_[question.exercise] = read.is_null() ? before : read;
    save();
  }
}

void Predictions::save() const {
  std::error_code ec;
  fs::create_directories(file_.parent_path(), ec);
  write_file(file_, kept_.dump(2) + "\n");
}

Table Predictions::table(const json& tables) const {
  Table table({"exercise", "you predicted", "this run", "question"},
              {"exercise", "predicted", "result", "question"});
  for (const Question& question : questions_) {
    const json predicted = kept_.value(question.exercise, json());
    const json result = question.answer(tables);
    if (result.is_null()) continue;
    const bool right_kind =
        question.choices.empty() ? predicted.is_number() : predicted.is_string();
    if (!right_kind) continue;
    const auto cell = [&](const json& value) {
      const std::string text = question.shown(value);
      return value.is_number() ? Cell(text, value.get<double>()) : Cell(text);
    };
    table.add_row({question.exercise, cell(predicted), cell(result), question.text});
  }
  return table;
}

}  // namespace carlo
