#include "grader/judge/comparisons.h"

#include <nlohmann/json.hpp>

#include <cstddef>

namespace carlo::grader {
namespace {

nlohmann::json comparison_json(const TestRecord& test, const Verdict& verdict) {
  nlohmann::json entry{{"test", test.sentence}, {"what", verdict.what}, {"p", *verdict.p}};
  if (!verdict.effect) return entry;
  entry["effect"] = verdict.effect->measured;
  entry["resolution"] = verdict.effect->resolution;
  entry["unit"] = verdict.effect->unit;
  entry["spread"] = verdict.effect->spread;
  return entry;
}

}  // namespace

void add_comparisons(nlohmann::json& document, const LabResult& result) {
  for (std::size_t i = 0; i < result.exercises.size(); ++i) {
    nlohmann::json comparisons = nlohmann::json::array();
    int exact_failures = 0;
    for (const TestRecord& test : result.exercises[i].tests) {
      exact_failures += test.problem.empty() ? 0 : 1;
      for (const Verdict& verdict : test.verdicts) {
        if (verdict.p) {
          comparisons.push_back(comparison_json(test, verdict));
        } else {
          exact_failures += verdict.passed ? 0 : 1;
        }
      }
    }
    document["exercises"][i]["comparisons"] = comparisons;
    document["exercises"][i]["exact_failures"] = exact_failures;
  }
}

}  // namespace carlo::grader
