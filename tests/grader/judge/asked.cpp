#include "grader/judge/asked.h"

#include "cli/error.h"

#include <nlohmann/json.hpp>

namespace carlo::grader {
namespace {

using nlohmann::json;

json to_document(const Asked& asked) {
  return {{"tag", asked.tag},           {"test", asked.sentence},
          {"probe", asked.probe},       {"params", to_text(asked.params)},
          {"question", asked.question}, {"rows", asked.rows},
          {"columns", asked.columns},   {"status", to_string(asked.status)},
          {"problem", asked.problem}};
}

Asked asked_of(const json& document) {
  Asked asked;
  document.at("tag").get_to(asked.tag);
  document.at("test").get_to(asked.sentence);
  document.at("probe").get_to(asked.probe);
  asked.params = params_from_text(document.at("params").get<std::string>());
  document.at("question").get_to(asked.question);
  document.at("rows").get_to(asked.rows);
  document.at("columns").get_to(asked.columns);
  asked.status = status_named(document.at("status").get<std::string>());
  document.at("problem").get_to(asked.problem);
  return asked;
}

}  // namespace

std::string to_json(const Questions& questions) {
  json document{{"seed", std::to_string(questions.seed)}, {"probes", json::array()}};
  for (const Asked& asked : questions.asked)
    document["probes"].push_back(to_document(asked));
  // A problem may quote what a student's program said: bytes that are no UTF-8 are replaced.
  return document.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

Questions questions_from_json(const std::string& text) {
  try {
    const json document = json::parse(text);
    Questions questions;
    questions.seed = std::stoull(document.at("seed").get<std::string>());
    for (const json& entry : document.at("probes"))
      questions.asked.push_back(asked_of(entry));
    return questions;
  } catch (const json::exception& error) {
    throw Error("this is no list of probes: {}", error.what());
  } catch (const std::logic_error&) {
    throw Error("this is no list of probes: its seed is no number");
  }
}

}  // namespace carlo::grader
