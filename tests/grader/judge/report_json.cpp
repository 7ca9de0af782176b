#include "grader/judge/comparisons.h"
#include "grader/judge/details.h"
#include "grader/judge/report.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace carlo::grader {
namespace {

using nlohmann::json;

/// What went wrong in one line, for programs.
std::string message(const ExerciseResult& result) {
  for (const TestRecord& test : result.tests) {
    if (test.status == Status::passed) continue;
    if (!test.problem.empty()) return test.sentence + ": " + test.problem;
    for (const Verdict& verdict : test.verdicts) {
      if (verdict.passed) continue;
      return fmt::format("{}: {}: {}; expected {}", test.sentence, verdict.what, verdict.measured,
                         verdict.expected);
    }
  }
  return "";
}

/// Whether the tests of each aspect that is judged passed.
json aspects_json(const ExerciseResult& result) {
  json aspects = json::object();
  for (const Aspect aspect : {Aspect::correctness, Aspect::variance, Aspect::efficiency}) {
    if (result.has(aspect)) aspects[to_string(aspect)] = result.passed(aspect);
  }
  return aspects;
}

/// The longest text for a student: a program can make what is said of it long.
constexpr std::size_t most_text = 20'000;

std::string shortened(std::string text) {
  if (text.size() > most_text) text = text.substr(0, most_text) + " ...\n";
  return text;
}

/// Without the colours of a terminal. What a program said is free of escapes already.
std::string plain(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\x1b') {
      out += text[i];
    } else {
      i = std::min(text.find('m', i), text.size());
    }
  }
  return out;
}

json exercise_json(const ExerciseResult& result, const LabResult& lab) {
  std::vector<std::string> ids;
  for (const Diagnosis& diagnosis : diagnoses(result))
    ids.push_back(diagnosis.id);
  std::vector<double> p_values;
  json tests = json::array();
  for (const TestRecord& test : result.tests) {
    tests.push_back({{"aspect", to_string(test.aspect)}});
    for (const Verdict& verdict : test.verdicts) {
      if (verdict.p) p_values.push_back(*verdict.p);
    }
  }
  return {{"tag", result.exercise.tag},
          {"points", result.earned()},
          {"max", result.exercise.points},
          {"status", to_string(result.status)},
          {"aspects", aspects_json(result)},
          {"diagnoses", ids},
          {"message", message(result)},
          {"text", shortened(plain(shortfall(result, lab)))},
          {"p_values", p_values},
          {"tests", tests}};
}

}  // namespace

std::string report_json(const LabResult& result) {
  json document{{"lab", result.lab.number},  {"points", result.earned()},
                {"max", result.possible()},  {"seed", std::to_string(result.seed)},
                {"sandbox", result.sandbox}, {"exercises", json::array()}};
  for (const ExerciseResult& entry : result.exercises)
    document["exercises"].push_back(exercise_json(entry, result));
  add_details(document, result);
  add_comparisons(document, result);
  // A message may hold what a student's program said: bytes that are no UTF-8 are replaced.
  return document.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace carlo::grader
