#include "course/json/json_fields.h"
#include "grader/grade/outputs.h"

#include <fmt/core.h>
#include <pugixml.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <utility>

namespace carlo::grader {
namespace {

/// Collects what pugixml writes. It can also write streams, but only those of the standard library
/// that it was built with.
struct Text : pugi::xml_writer {
  std::string all;
  void write(const void* data, std::size_t size) override {
    all.append(static_cast<const char*>(data), size);
  }
};

double seconds_of(const LabGrade& lab) {
  return lab.compile_seconds + lab.judge_seconds;
}

/// Returns the text for the student; if nothing was judged, the compiler's messages too.
std::string output_of(const LabGrade& lab, const ExerciseResult& exercise) {
  std::string text = text_of(lab, exercise);
  if (lab.unjudged && !lab.compiler.empty()) text += "\n" + lab.compiler;
  return text;
}

/// Removes what XML 1.0 does not allow: most control characters, U+FFFE, U+FFFF, and invalid UTF-8.
/// A student's program may have printed any of them.
std::string xml_text(const std::string& text) {
  std::string clean = valid_utf8(text);
  for (char& c : clean) {
    if (static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\t') c = ' ';
  }
  for (const char* none : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) {
    for (std::size_t at = 0; (at = clean.find(none, at)) != std::string::npos;)
      clean.replace(at, 3, 3, ' ');
  }
  return clean;
}

/// Returns the status that its points follow from, as a word for programs.
std::string state_of(const ExerciseResult& exercise) {
  if (exercise.right_by_itself()) return "right_by_itself";
  return to_string(exercise.by_itself ? exercise.by_itself->status : exercise.status);
}

void add_case(pugi::xml_node& suite, const LabGrade& lab, const ExerciseResult& exercise) {
  pugi::xml_node entry = suite.append_child("testcase");
  entry.append_attribute("classname") = fmt::format("lab{:02}", lab.result.lab).c_str();
  entry.append_attribute("name") = xml_text(exercise.tag + " " + exercise.title).c_str();
  if (points_of(exercise) == exercise.max) return;
  pugi::xml_node problem = entry.append_child(points_of(exercise) ? "failure" : "error");
  problem.append_attribute("message") = state_of(exercise).c_str();
  problem.append_child(pugi::node_pcdata).set_value(xml_text(output_of(lab, exercise)).c_str());
}

}  // namespace

namespace {

/// Gradescope's data about one exercise.
struct GradescopeTest {
  const LabGrade* lab = nullptr;
  const ExerciseResult* exercise = nullptr;
};

void fields(JsonFields& json, const GradescopeTest& test) {
  const ExerciseResult& exercise = *test.exercise;
  const std::optional<double> points = points_of(exercise);
  json.also("name", exercise.tag + " " + exercise.title);
  json.also("number", exercise.number());
  json.also("max_score", exercise.max);
  json.also("score", points);
  json.also("status", points == exercise.max ? "passed" : "failed");
  json.also("output", output_of(*test.lab, exercise));
  json.also("output_format", "text");
  json.also("visibility", "visible");
  json.also("extra_data", std::map<std::string, std::string>{{"status", state_of(exercise)}});
}

struct GradescopeResults {
  std::string summary;
  std::vector<GradescopeTest> tests;
  double seconds = 0;
  std::optional<double> score;
};

void fields(JsonFields& json, GradescopeResults& results) {
  json("execution_time", results.seconds);
  json("output", results.summary);
  json.also("output_format", "text");
  json.also("visibility", "visible");
  json.also("stdout_visibility", "hidden");
  json("tests", results.tests);
  json("score", results.score);
}

}  // namespace

std::string gradescope_json(const Record& record) {
  GradescopeResults results;
  for (const LabGrade& lab : record.labs) {
    results.seconds += seconds_of(lab);
    if (!lab.note.empty()) {
      results.summary += fmt::format("Lab {:02}: {}\n", lab.result.lab, lab.note);
    }
    if (!lab.compiler.empty()) results.summary += lab.compiler + "\n";
    for (const ExerciseResult& exercise : lab.result.exercises)
      results.tests.push_back({&lab, &exercise});
  }
  for (const std::string& file : record.ignored)
    results.summary += "not looked at: " + file + "\n";
  if (record.complete()) results.score = record.points();
  return json_text(results, 1) + "\n";
}

std::string junit_xml(const Record& record) {
  pugi::xml_document document;
  pugi::xml_node suites = document.append_child("testsuites");
  suites.append_attribute("name") = xml_text(record.name).c_str();
  for (const LabGrade& lab : record.labs) {
    int failures = 0, errors = 0;
    for (const ExerciseResult& exercise : lab.result.exercises) {
      const std::optional<double> points = points_of(exercise);
      errors += points ? 0 : 1;
      failures += points && *points < exercise.max ? 1 : 0;
    }
    pugi::xml_node suite = suites.append_child("testsuite");
    suite.append_attribute("name") =
        fmt::format("Lab {:02} {}", lab.result.lab, lab.result.title).c_str();
    suite.append_attribute("tests") = static_cast<int>(lab.result.exercises.size());
    suite.append_attribute("failures") = failures;
    suite.append_attribute("errors") = errors;
    suite.append_attribute("time") = fmt::format("{:.2f}", seconds_of(lab)).c_str();
    for (const ExerciseResult& exercise : lab.result.exercises)
      add_case(suite, lab, exercise);
  }
  Text text;
  document.save(text, " ");
  return std::move(text.all);
}

}  // namespace carlo::grader
