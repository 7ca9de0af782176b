#include "cli/atomic_file.h"
#include "cli/error.h"
#include "grader/grade/record.h"

namespace carlo::grader {
namespace {

using nlohmann::json;

LabState state_of(const std::string& name) {
  for (const LabState state : {LabState::judged, LabState::not_submitted, LabState::refused,
                               LabState::does_not_compile, LabState::grader_error}) {
    if (to_string(state) == name) return state;
  }
  throw Error("unknown state \"{}\"", name);
}

json exercise_json(const ExerciseGrade& exercise) {
  json entry{{"tag", exercise.tag}, {"title", exercise.title},   {"points", nullptr},
             {"max", exercise.max}, {"status", exercise.status}, {"text", exercise.text}};
  if (exercise.points) entry["points"] = *exercise.points;
  return entry;
}

ExerciseGrade exercise_from(const json& entry) {
  ExerciseGrade exercise;
  entry.at("tag").get_to(exercise.tag);
  entry.at("title").get_to(exercise.title);
  if (!entry.at("points").is_null()) exercise.points = entry.at("points").get<double>();
  entry.at("max").get_to(exercise.max);
  entry.at("status").get_to(exercise.status);
  entry.at("text").get_to(exercise.text);
  return exercise;
}

json lab_json(const LabGrade& lab) {
  json entry{{"lab", lab.number},
             {"title", lab.title},
             {"state", to_string(lab.state)},
             {"note", lab.note},
             {"compiler", lab.compiler},
             {"report", lab.report},
             {"verdict", lab.verdict},
             {"sandbox", lab.sandbox},
             {"compile_seconds", lab.compile_seconds},
             {"judge_seconds", lab.judge_seconds},
             {"compile_peak_bytes", lab.compile_peak_bytes},
             {"judge_peak_bytes", lab.judge_peak_bytes},
             {"exercises", json::array()}};
  for (const ExerciseGrade& exercise : lab.exercises)
    entry["exercises"].push_back(exercise_json(exercise));
  return entry;
}

LabGrade lab_from(const json& entry) {
  LabGrade lab;
  entry.at("lab").get_to(lab.number);
  entry.at("title").get_to(lab.title);
  lab.state = state_of(entry.at("state").get<std::string>());
  entry.at("note").get_to(lab.note);
  entry.at("compiler").get_to(lab.compiler);
  entry.at("report").get_to(lab.report);
  lab.verdict = entry.at("verdict");
  entry.at("sandbox").get_to(lab.sandbox);
  entry.at("compile_seconds").get_to(lab.compile_seconds);
  entry.at("judge_seconds").get_to(lab.judge_seconds);
  entry.at("compile_peak_bytes").get_to(lab.compile_peak_bytes);
  entry.at("judge_peak_bytes").get_to(lab.judge_peak_bytes);
  for (const json& exercise : entry.at("exercises"))
    lab.exercises.push_back(exercise_from(exercise));
  return lab;
}

}  // namespace

std::string to_json(const Record& record) {
  json document{{"name", record.name},
                {"key", record.key},
                {"ignored", record.ignored},
                {"labs", json::array()}};
  for (const LabGrade& lab : record.labs)
    document["labs"].push_back(lab_json(lab));
  // Names of files and the compiler's words may hold bytes that are no UTF-8.
  return document.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

Record record_from_json(const std::string& text) {
  try {
    const json document = json::parse(text);
    Record record;
    document.at("name").get_to(record.name);
    document.at("key").get_to(record.key);
    document.at("ignored").get_to(record.ignored);
    for (const json& lab : document.at("labs"))
      record.labs.push_back(lab_from(lab));
    return record;
  } catch (const json::exception& error) {
    throw Error("no record of a grading: {}", error.what());
  }
}

std::optional<Record> load_record(const std::filesystem::path& folder) {
  try {
    return record_from_json(read_file(folder / "record.json"));
  } catch (const Error&) {
    return {};
  }
}

}  // namespace carlo::grader
