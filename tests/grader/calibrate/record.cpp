#include "grader/calibrate/record.h"

#include "cli/error.h"

#include <nlohmann/json.hpp>

#include <limits>
#include <map>

namespace carlo::grader {
namespace {

using nlohmann::json;

double number(const json& entry, const char* name) {
  const auto found = entry.find(name);
  if (found == entry.end() || found->is_null()) return std::numeric_limits<double>::quiet_NaN();
  return found->get<double>();
}

Comparison comparison_from(const json& entry) {
  return {entry.at("test"),
          entry.at("what"),
          number(entry, "p"),
          number(entry, "effect"),
          number(entry, "resolution"),
          entry.value("unit", ""),
          number(entry, "spread")};
}

Judgement judgement_from(const json& entry) {
  Judgement judgement{
      entry.at("tag"),           entry.at("status"), entry.at("message"), entry.at("diagnoses"), {},
      entry.at("exact_failures")};
  for (const json& comparison : entry.at("comparisons"))
    judgement.comparisons.push_back(comparison_from(comparison));
  return judgement;
}

json to_json(const Judgement& judgement) {
  json comparisons = json::array();
  for (const Comparison& c : judgement.comparisons) {
    comparisons.push_back({{"test", c.test},
                           {"what", c.what},
                           {"p", c.p},
                           {"effect", c.effect},
                           {"resolution", c.resolution},
                           {"unit", c.unit},
                           {"spread", c.spread}});
  }
  return {{"tag", judgement.tag},         {"status", judgement.status},
          {"message", judgement.message}, {"diagnoses", judgement.diagnoses},
          {"comparisons", comparisons},   {"exact_failures", judgement.exact_failures}};
}

}  // namespace

std::vector<std::pair<ComparisonName, const Comparison*>> comparisons(const Record& record) {
  std::vector<std::pair<ComparisonName, const Comparison*>> list;
  std::map<ComparisonName, int> seen;
  for (const Judgement& judgement : record.exercises) {
    for (const Comparison& comparison : judgement.comparisons) {
      ComparisonName name{judgement.tag, comparison.test, comparison.what, 0};
      const int place = seen[name]++;
      std::get<3>(name) = place;
      list.emplace_back(name, &comparison);
    }
  }
  return list;
}

std::string to_line(const Record& record) {
  json document{{"lab", record.key.lab},         {"what", record.key.what},
                {"seed", record.key.seed},       {"programs", record.key.programs},
                {"exit", record.exit_code},      {"cpu_seconds", record.cpu_seconds},
                {"megabytes", record.megabytes}, {"exercises", json::array()}};
  for (const Judgement& judgement : record.exercises)
    document["exercises"].push_back(to_json(judgement));
  return document.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::optional<Record> record_from(const std::string& line) {
  try {
    const json document = json::parse(line);
    Record record;
    record.key = {document.at("lab"), document.at("what"), document.at("seed"),
                  document.at("programs")};
    record.exit_code = document.at("exit");
    record.cpu_seconds = document.at("cpu_seconds");
    record.megabytes = document.at("megabytes");
    for (const json& entry : document.at("exercises"))
      record.exercises.push_back(judgement_from(entry));
    return record;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

std::vector<Judgement> judgements_from(const std::string& verdicts) {
  try {
    const json document = json::parse(verdicts);
    std::vector<Judgement> list;
    for (const json& entry : document.at("exercises"))
      list.push_back(judgement_from(entry));
    if (list.empty()) throw Error("the judge's verdicts hold no exercise");
    return list;
  } catch (const json::exception& error) {
    throw Error("the judge's verdicts: {}", error.what());
  }
}

}  // namespace carlo::grader
