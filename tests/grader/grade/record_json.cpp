#include "course/verdict/verdict_json.h"
#include "grader/grade/record.h"
#include "support/atomic_file.h"
#include "support/error.h"

namespace carlo::grader {

static void fields(JsonFields& json, LabGrade& lab) {
  std::string state = state_of(lab);
  json("state", state);
  if (json.reading() && state != state_of({})) lab.unjudged = status_named(state);
  json("result", lab.result);
  json("note", lab.note);
  json("compiler", lab.compiler);
  json("report", lab.report);
  json("compile_seconds", lab.compile_seconds);
  json("judge_seconds", lab.judge_seconds);
  json("compile_peak_bytes", lab.compile_peak_bytes);
  json("judge_peak_bytes", lab.judge_peak_bytes);
}

static void fields(JsonFields& json, Record& record) {
  json("name", record.name);
  json("key", record.key);
  json("ignored", record.ignored);
  json("labs", record.labs);
}

std::string to_json(const Record& record) {
  return json_text(record, 1) + "\n";
}

Record record_from_json(const std::string& text) {
  return from_json_text<Record>(text, "no record of a grading");
}

std::optional<Record> load_record(const std::filesystem::path& folder) {
  try {
    return record_from_json(read_file(folder / "record.json"));
  } catch (const Error&) {
    return {};
  }
}

}  // namespace carlo::grader
