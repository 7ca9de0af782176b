#include "cli/atomic_file.h"
#include "cli/error.h"
#include "grader/grade/record.h"
#include "verdict/verdict_json.h"

#include <nlohmann/json.hpp>

namespace carlo::grader {
namespace {

using nlohmann::json;

json lab_json(const LabGrade& lab) {
  return {{"state", state_of(lab)},
          {"result", to_json(lab.result)},
          {"note", lab.note},
          {"compiler", lab.compiler},
          {"report", lab.report},
          {"compile_seconds", lab.compile_seconds},
          {"judge_seconds", lab.judge_seconds},
          {"compile_peak_bytes", lab.compile_peak_bytes},
          {"judge_peak_bytes", lab.judge_peak_bytes}};
}

LabGrade lab_from(const json& entry) {
  LabGrade lab;
  const auto state = entry.at("state").get<std::string>();
  if (state != state_of({})) lab.unjudged = status_named(state);
  lab.result = lab_result_from_json(entry.at("result"));
  entry.at("note").get_to(lab.note);
  entry.at("compiler").get_to(lab.compiler);
  entry.at("report").get_to(lab.report);
  entry.at("compile_seconds").get_to(lab.compile_seconds);
  entry.at("judge_seconds").get_to(lab.judge_seconds);
  entry.at("compile_peak_bytes").get_to(lab.compile_peak_bytes);
  entry.at("judge_peak_bytes").get_to(lab.judge_peak_bytes);
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
  return dumped(document, 1) + "\n";
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
