#include "course/verdict/verdict_json.h"
#include "course/verdict/verdict_text.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

using namespace carlo;
using nlohmann::json;

namespace {

/// A result in which no member has its default value.
LabResult full_result() {
  Verdict verdict;
  verdict.what = "the mean";
  verdict.measured = "1";
  verdict.expected = "2";
  verdict.certainty = "z = 9";
  verdict.p = 1e-300;
  verdict.effect = Effect{.5, std::numeric_limits<double>::quiet_NaN(), "of all", .25};
  verdict.diagnoses = {{"off-by-one", "one is missing."}};
  verdict.figure = Figure{"title", "note", ListingFigure{{"a"}, {{"b"}}}};
  TestRecord test{"Lab 7.1", "it holds", {verdict}, Status::crashed, "it crashed", "said"};
  test.skipped = test.lacks_line = true;
  test.needs = "Lab 7.2";
  test.aspect = Aspect::efficiency;
  test.lost_lines = 3;
  ExerciseResult exercise;
  exercise.tag = "Lab 7.1";
  exercise.title = "First";
  exercise.status = Status::timeout;
  exercise.points = 1.5;
  exercise.max = 2;
  exercise.tests = {test};
  exercise.diagnoses = verdict.diagnoses;
  exercise.unsound = {"Lab 7.2"};
  exercise.missing = {"f"};
  exercise.begun = true;
  exercise.by_itself = ByItself{Status::failed, 1.5, {"Lab 7.2"}, verdict.diagnoses, {"it holds"}};
  LabResult result;
  result.lab = 7;
  result.title = "Seventh";
  result.whole = false;
  result.exercises = {exercise};
  result.seed = 18'446'744'073'709'551'615U;
  result.usual_seed = true;
  result.sandbox = "s";
  return result;
}

json to_json(const LabResult& result) {
  return json::parse(to_text(result));
}

LabResult lab_result_from(const json& document) {
  return lab_result_from_text(document.dump());
}

/// All members of a document, each with a pointer to it.
std::vector<json::json_pointer> places_in(const json& document) {
  std::vector<json::json_pointer> places;
  const json flat = document.flatten();
  for (const auto& [place, value] : flat.items()) {
    for (json::json_pointer at(place); !at.empty(); at.pop_back())
      places.push_back(at);
  }
  return places;
}

}  // namespace

TEST_CASE("verdicts survive their JSON", "[verdict]") {
  const std::string text = to_text(full_result());
  const LabResult back = lab_result_from_text(text);
  CHECK(to_text(back) == text);
  CHECK(back.seed == 18'446'744'073'709'551'615U);
  CHECK(back.usual_seed);
  CHECK_FALSE(back.whole);
  CHECK_FALSE(back.cut);
  const TestRecord& test = back.exercises.at(0).tests.at(0);
  CHECK(test.tag == "Lab 7.1");
  CHECK(test.aspect == Aspect::efficiency);
  CHECK(test.lacks_line);
  CHECK(test.lost_lines == 3);
  CHECK(test.verdicts.at(0).p == 1e-300);
  CHECK(std::isnan(test.verdicts.at(0).effect->resolution));
  CHECK(test.verdicts.at(0).figure.has_value());
}

TEST_CASE("what lacks a member, or has one of another type, is no verdict", "[verdict]") {
  const json whole = to_json(full_result());
  for (const json::json_pointer& place : places_in(whole)) {
    INFO(place.to_string());
    json wrong = whole;
    wrong[place] = json::array({json::object()});
    // Both are sums, for other programs; they are not read back.
    const bool derived =
        place == json::json_pointer("/points") || place == json::json_pointer("/max");
    if (!derived) CHECK_THROWS_AS(lab_result_from(wrong), Error);
  }
  for (const char* text : {"", "{", "{}", "[]", "3", "null"})
    CHECK_THROWS_AS(lab_result_from_text(text), Error);
  json other = whole;
  other["exercises"][0]["tag"] = "7.1";
  CHECK_THROWS_AS(lab_result_from(other), Error);
  other = whole;
  other["exercises"][0]["status"] = "fine";
  CHECK_THROWS_AS(lab_result_from(other), Error);
}

TEST_CASE("the JSON is valid whatever a program said", "[verdict]") {
  LabResult result = full_result();
  result.exercises[0].tests[0].problem = "threw \xFF\"\n";
  const LabResult back = lab_result_from_text(to_text(result));
  CHECK(back.exercises[0].tests[0].problem == "threw \xEF\xBF\xBD\"\n");
  CHECK(valid_utf8("a\xFF") == "a\xEF\xBF\xBD");
}

TEST_CASE("the verdicts of a lab stay below two megabytes in JSON, and say that they are cut",
          "[verdict]") {
  LabResult result = full_result();
  TestRecord& test = result.exercises[0].tests[0];
  Verdict& large = test.verdicts[0];
  large.measured = std::string(50'000, 'x');
  const std::vector<double> cells(1024, 2.0 / 3);
  large.figure = Figure{"tiles", "", GridFigure{"x", "y", 32, cells, cells, cells}};
  test.verdicts = std::vector<Verdict>(50, large);
  test.problem = std::string(100'000, '\x01');
  test.printed = std::string(100'000, '\xFF');
  result.exercises[0].tests = std::vector<TestRecord>(40, test);
  const std::string text = to_text(result);
  CHECK(text.size() <= most_json_bytes);
  const LabResult back = lab_result_from_text(text);
  CHECK(back.cut);
  REQUIRE(back.exercises[0].tests.size() == 40);
  CHECK(back.exercises[0].tests[0].verdicts[0].figure.has_value());
  CHECK(back.exercises[0].tests[39].verdicts.empty());
}

TEST_CASE("a problem is cut where there is no room for it, and never made longer", "[verdict]") {
  LabResult result = full_result();
  TestRecord test = result.exercises[0].tests[0];
  test.problem = test.printed = std::string(2000, 'x');
  result.exercises[0].tests = std::vector<TestRecord>(400, test);
  // The long ones leave less space than a hundred of these take.
  test.problem = std::string(90, 'y');
  result.exercises[0].tests.insert(result.exercises[0].tests.end(), 100, test);
  const std::vector<TestRecord> back = lab_result_from_text(to_text(result)).exercises[0].tests;
  REQUIRE(back.size() == 500);
  CHECK(back[399].problem == std::string(100, 'x'));
  CHECK(back[400].problem == test.problem);
  CHECK(back[499].problem == test.problem);
}

TEST_CASE("verdicts that only lack figures are not cut", "[verdict]") {
  LabResult result = full_result();
  TestRecord& test = result.exercises[0].tests[0];
  const std::vector<double> cells(1024, 2.0 / 3);
  test.verdicts[0].figure = Figure{"tiles", "", GridFigure{"x", "y", 32, cells, cells, cells}};
  test.verdicts = std::vector<Verdict>(100, test.verdicts[0]);
  const LabResult back = lab_result_from_text(to_text(result));
  CHECK_FALSE(back.cut);
  CHECK(back.exercises[0].tests[0].verdicts.size() == 100);
  CHECK_FALSE(back.exercises[0].tests[0].verdicts[99].figure.has_value());
}

TEST_CASE("every status and aspect has a name, and is found by it", "[verdict]") {
  for (int i = 0; i <= static_cast<int>(Status::grader_error); ++i) {
    const auto status = static_cast<Status>(i);
    CHECK(status_named(to_string(status)) == status);
  }
  for (const Aspect aspect : {Aspect::correctness, Aspect::variance, Aspect::efficiency})
    CHECK(aspect_named(to_string(aspect)) == aspect);
  CHECK_THROWS_AS(status_named("fine"), Error);
  CHECK_THROWS_AS(aspect_named("speed"), Error);
}

TEST_CASE("a text says by which key help comes where there is one", "[verdict]") {
  ExerciseResult result = full_result().exercises[0];
  result.begun = false;
  CHECK(shortfall(result).ends_with("For help: ./carlo hint 7.1\n"));
  CHECK(shortfall(result, Help::by_key).ends_with("For help: press h\n"));
  CHECK(message(result) == "it holds: it crashed");
}
