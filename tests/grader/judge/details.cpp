#include "grader/judge/details.h"

#include "grader/judge/figure_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

namespace carlo::grader {

using nlohmann::json;

namespace {

/// The longest words of one kind: a student's program can make a message long.
constexpr std::size_t most_words = 2000;

std::string cut(const std::string& text) {
  return text.size() <= most_words ? text : text.substr(0, most_words) + " ...";
}

std::size_t bytes(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace).size();
}

/// What is left of the bytes that the document may grow by. The shares add up to what leaves room
/// for the rest of it.
struct Ration {
  std::size_t figures = most_json_bytes / 2;
  std::size_t printed = most_json_bytes / 8;
  std::size_t verdicts = most_json_bytes / 4;
};

/// Whether the value still fits; if so, it is taken off what is left.
bool fits(const json& value, std::size_t& left) {
  const std::size_t size = bytes(value);
  if (size > left) return false;
  left -= size;
  return true;
}

json verdict_json(const Verdict& verdict) {
  auto diagnoses = json::array();
  for (const Diagnosis& diagnosis : verdict.diagnoses)
    diagnoses.push_back({{"id", diagnosis.id}, {"sentence", cut(diagnosis.sentence)}});
  json entry{{"what", cut(verdict.what)},         {"measured", cut(verdict.measured)},
             {"expected", cut(verdict.expected)}, {"certainty", cut(verdict.certainty)},
             {"passed", verdict.passed},          {"diagnoses", diagnoses}};
  if (verdict.p) entry["p"] = *verdict.p;
  return entry;
}

json test_json(const TestRecord& test, Ration& left) {
  json entry{{"sentence", test.sentence},    {"status", to_string(test.status)},
             {"problem", cut(test.problem)}, {"printed", cut(test.printed)},
             {"skipped", test.skipped},      {"needs", cut(test.needs)},
             {"verdicts", json::array()}};
  if (!fits(entry["problem"], left.printed)) entry["problem"] = test.problem.substr(0, 100);
  if (!fits(entry["printed"], left.printed)) entry["printed"] = "";
  for (const Verdict& verdict : test.verdicts) {
    json words = verdict_json(verdict);
    if (!fits(words, left.verdicts)) continue;
    if (verdict.figure && !verdict.passed) {
      json figure = to_json(*verdict.figure);
      if (fits(figure, left.figures)) words["figure"] = std::move(figure);
    }
    entry["verdicts"].push_back(std::move(words));
  }
  return entry;
}

/// Exercises that this one builds on and that are not right yet.
std::vector<std::string> unsound(const ExerciseResult& result, const LabResult& lab) {
  std::vector<std::string> tags;
  const std::vector<std::string>& uses = result.exercise.uses;
  for (const ExerciseResult& other : lab.exercises) {
    const bool used = std::find(uses.begin(), uses.end(), other.exercise.tag) != uses.end();
    if (used && other.status != Status::passed) tags.push_back(other.exercise.tag);
  }
  return tags;
}

}  // namespace

void add_details(json& document, const LabResult& result) {
  document["title"] = result.lab.title;
  document["whole"] = result.exercises.size() == result.lab.exercises.size();
  Ration left;
  for (std::size_t i = 0; i < result.exercises.size(); ++i) {
    const ExerciseResult& from = result.exercises[i];
    json& to = document["exercises"][i];
    to["title"] = from.exercise.title;
    if (to.contains("message")) to["message"] = cut(to["message"].get<std::string>());
    to["unsound"] = unsound(from, result);
    json& tests = to["tests"];
    for (std::size_t k = 0; k < from.tests.size(); ++k)
      tests[k].update(test_json(from.tests[k], left));
  }
}

}  // namespace carlo::grader
