#include "verdict/verdict_json.h"

#include "cli/error.h"
#include "verdict/figure_json.h"
#include "verdict/printed.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace carlo {
namespace {

using nlohmann::json;

// Writing ----------------------------------------------------------------------------------------

/// The longest words of one kind: a student's program can make a message long.
constexpr std::size_t most_words = 2000;

std::string cut(const std::string& text) {
  return text.size() <= most_words ? text : text.substr(0, most_words) + " ...";
}

/// What is left of the bytes that the document may grow by. The shares add up to what leaves room
/// for the rest of it.
class Ration {
 public:
  std::size_t figures = most_json_bytes / 2;
  std::size_t printed = most_json_bytes / 8;
  std::size_t verdicts = most_json_bytes / 4;
  bool lost_verdicts = false;

  /// Whether the value still fits; if so, it is taken off what is left.
  bool gives(std::size_t& left, const json& value) {
    const std::size_t size = dumped(value).size();
    if (size > left) return false;
    left -= size;
    return true;
  }
};

json list_of(const std::vector<Diagnosis>& diagnoses) {
  json list = json::array();
  for (const Diagnosis& diagnosis : diagnoses)
    list.push_back({{"id", diagnosis.id}, {"sentence", cut(diagnosis.sentence)}});
  return list;
}

json verdict_json(const Verdict& verdict) {
  json entry{{"passed", verdict.passed},
             {"what", cut(verdict.what)},
             {"measured", cut(verdict.measured)},
             {"expected", cut(verdict.expected)},
             {"certainty", cut(verdict.certainty)},
             {"diagnoses", list_of(verdict.diagnoses)}};
  if (verdict.p) entry["p"] = *verdict.p;
  if (const std::optional<Effect>& effect = verdict.effect) {
    entry["effect"] = {{"measured", effect->measured},
                       {"resolution", effect->resolution},
                       {"unit", effect->unit},
                       {"spread", effect->spread}};
  }
  return entry;
}

json test_json(const TestRecord& test, Ration& left) {
  json entry{{"sentence", test.sentence},        {"aspect", to_string(test.aspect)},
             {"status", to_string(test.status)}, {"problem", cut(test.problem)},
             {"printed", cut(test.printed)},     {"lost_lines", test.lost_lines},
             {"lacks_line", test.lacks_line},    {"skipped", test.skipped},
             {"needs", cut(test.needs)},         {"verdicts", json::array()}};
  if (!left.gives(left.printed, entry["problem"])) entry["problem"] = test.problem.substr(0, 100);
  if (!left.gives(left.printed, entry["printed"])) entry["printed"] = "";
  for (const Verdict& verdict : test.verdicts) {
    json words = verdict_json(verdict);
    if (!left.gives(left.verdicts, words)) {
      left.lost_verdicts = true;
      continue;
    }
    if (verdict.figure && !verdict.passed) {
      json figure = to_json(*verdict.figure);
      if (left.gives(left.figures, figure)) words["figure"] = std::move(figure);
    }
    entry["verdicts"].push_back(std::move(words));
  }
  return entry;
}

json exercise_json(const ExerciseResult& result, Ration& left) {
  json tests = json::array();
  for (const TestRecord& test : result.tests)
    tests.push_back(test_json(test, left));
  return {{"tag", result.tag},
          {"title", result.title},
          {"status", to_string(result.status)},
          {"points", result.points},
          {"max", result.max},
          {"diagnoses", list_of(result.diagnoses)},
          {"unsound", result.unsound},
          {"missing", result.missing},
          {"begun", result.begun},
          {"tests", std::move(tests)}};
}

// Reading. Library exceptions become Errors in the functions that have a name outside. -----------

/// What is not known, or no number, is NaN.
double number(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

std::vector<Diagnosis> diagnoses_from(const json& list) {
  std::vector<Diagnosis> diagnoses;
  for (const json& entry : list)
    diagnoses.push_back({entry.at("id"), entry.at("sentence")});
  return diagnoses;
}

Verdict verdict_from(const json& entry) {
  Verdict verdict;
  entry.at("passed").get_to(verdict.passed);
  entry.at("what").get_to(verdict.what);
  entry.at("measured").get_to(verdict.measured);
  entry.at("expected").get_to(verdict.expected);
  entry.at("certainty").get_to(verdict.certainty);
  verdict.diagnoses = diagnoses_from(entry.at("diagnoses"));
  if (const auto p = entry.find("p"); p != entry.end()) verdict.p = number(*p);
  if (const auto found = entry.find("effect"); found != entry.end()) {
    verdict.effect = Effect{number(found->at("measured")), number(found->at("resolution")),
                            found->at("unit"), number(found->at("spread"))};
  }
  if (const auto figure = entry.find("figure"); figure != entry.end()) {
    verdict.figure = figure_from_json(*figure);
  }
  return verdict;
}

TestRecord test_from(const json& entry, const std::string& tag) {
  TestRecord test;
  test.tag = tag;
  entry.at("sentence").get_to(test.sentence);
  test.aspect = aspect_named(entry.at("aspect").get<std::string>());
  test.status = status_named(entry.at("status").get<std::string>());
  entry.at("problem").get_to(test.problem);
  entry.at("printed").get_to(test.printed);
  entry.at("lost_lines").get_to(test.lost_lines);
  entry.at("lacks_line").get_to(test.lacks_line);
  entry.at("skipped").get_to(test.skipped);
  entry.at("needs").get_to(test.needs);
  for (const json& verdict : entry.at("verdicts"))
    test.verdicts.push_back(verdict_from(verdict));
  return test;
}

ExerciseResult exercise_from(const json& entry) {
  ExerciseResult result;
  entry.at("tag").get_to(result.tag);
  if (!result.tag.starts_with("Lab "))
    throw Error("\"{}\" is no exercise", clipped(result.tag, 40));
  entry.at("title").get_to(result.title);
  result.status = status_named(entry.at("status").get<std::string>());
  entry.at("points").get_to(result.points);
  entry.at("max").get_to(result.max);
  result.diagnoses = diagnoses_from(entry.at("diagnoses"));
  entry.at("unsound").get_to(result.unsound);
  entry.at("missing").get_to(result.missing);
  entry.at("begun").get_to(result.begun);
  for (const json& test : entry.at("tests"))
    result.tests.push_back(test_from(test, result.tag));
  return result;
}

template <class Read>
auto reading(const Read& read) {
  try {
    return read();
  } catch (const json::exception& error) {
    throw Error("these are no verdicts: {}", error.what());
  } catch (const std::logic_error&) {
    throw Error("these are no verdicts: the seed is no number");
  }
}

}  // namespace

json to_json(const LabResult& result) {
  Ration left;
  json exercises = json::array();
  for (const ExerciseResult& exercise : result.exercises)
    exercises.push_back(exercise_json(exercise, left));
  return {{"lab", result.lab},
          {"title", result.title},
          {"whole", result.whole},
          {"points", result.earned()},
          {"max", result.possible()},
          {"seed", std::to_string(result.seed)},
          {"usual_seed", result.usual_seed},
          {"sandbox", result.sandbox},
          {"cut", result.cut || left.lost_verdicts},
          {"exercises", std::move(exercises)}};
}

LabResult lab_result_from_json(const json& document) {
  return reading([&] {
    LabResult result;
    document.at("lab").get_to(result.lab);
    document.at("title").get_to(result.title);
    document.at("whole").get_to(result.whole);
    result.seed = std::stoull(document.at("seed").get<std::string>());
    document.at("usual_seed").get_to(result.usual_seed);
    document.at("sandbox").get_to(result.sandbox);
    document.at("cut").get_to(result.cut);
    for (const json& exercise : document.at("exercises"))
      result.exercises.push_back(exercise_from(exercise));
    return result;
  });
}

json to_json(const ExerciseResult& result) {
  Ration left;
  left.figures = 0;
  return exercise_json(result, left);
}

ExerciseResult exercise_result_from_json(const json& document) {
  return reading([&] { return exercise_from(document); });
}

std::string dumped(const json& document, int indent) {
  return document.dump(indent, ' ', false, json::error_handler_t::replace);
}

std::string valid_utf8(const std::string& text) {
  return json::parse(dumped(text)).get<std::string>();
}

std::string to_text(const LabResult& result) {
  return dumped(to_json(result)) + "\n";
}

LabResult lab_result_from_text(const std::string& text) {
  return reading([&] { return lab_result_from_json(json::parse(text)); });
}

}  // namespace carlo
