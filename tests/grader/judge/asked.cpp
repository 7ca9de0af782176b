#include "grader/judge/asked.h"

#include "course/json/json_fields.h"

namespace carlo::grader {

static void fields(JsonFields& json, Asked& asked) {
  json("tag", asked.tag);
  json("test", asked.sentence);
  json("probe", asked.probe);
  std::string params = to_text(asked.params);
  json("params", params);
  if (json.reading()) asked.params = params_from_text(params);
  json("question", asked.question);
  json("rows", asked.rows);
  json("columns", asked.columns);
  json.named("status", asked.status, to_string, status_named);
  json("problem", asked.problem);
}

static void fields(JsonFields& json, Questions& questions) {
  json.as_text("seed", questions.seed);
  json("probes", questions.asked);
}

std::string to_json(const Questions& questions) {
  return json_text(questions, 1) + "\n";
}

Questions questions_from_json(const std::string& text) {
  return from_json_text<Questions>(text, "this is no list of probes");
}

}  // namespace carlo::grader
