#include "grader/calibrate/record.h"

#include "course/verdict/verdict_json.h"
#include "support/error.h"

#include <algorithm>
#include <limits>
#include <map>

namespace carlo::grader {

std::vector<Comparison> comparisons(const Record& record) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<Comparison> list;
  std::map<ComparisonName, int> seen;
  for (const ExerciseResult& exercise : record.result.exercises) {
    for (const TestRecord& test : exercise.tests) {
      for (const Verdict& verdict : test.verdicts) {
        if (!verdict.p) continue;
        ComparisonName name{exercise.tag, test.sentence, verdict.what, 0};
        const int place = seen[name]++;
        std::get<3>(name) = place;
        list.push_back(
            {name, *verdict.p, verdict.effect.value_or(Effect{unknown, unknown, "", unknown})});
      }
    }
  }
  return list;
}

int exact_failures(const ExerciseResult& exercise) {
  int count = 0;
  for (const TestRecord& test : exercise.tests) {
    count += test.problem.empty() ? 0 : 1;
    count += static_cast<int>(
        std::count_if(test.verdicts.begin(), test.verdicts.end(),
                      [](const Verdict& verdict) { return !verdict.p && !verdict.passed; }));
  }
  return count;
}

LabResult kept_of(LabResult result) {
  for (ExerciseResult& exercise : result.exercises) {
    for (TestRecord& test : exercise.tests) {
      test.printed.clear();
      std::erase_if(test.verdicts,
                    [](const Verdict& verdict) { return !verdict.p && verdict.passed; });
      for (Verdict& verdict : test.verdicts) {
        verdict.figure.reset();
        verdict.certainty.clear();
        if (verdict.passed) verdict.measured = verdict.expected = "";
      }
    }
  }
  return result;
}

static void fields(JsonFields& json, Record& record) {
  json("lab", record.key.lab);
  json("what", record.key.what);
  json("seed", record.key.seed);
  json("programs", record.key.programs);
  json("exit", record.exit_code);
  json("cpu_seconds", record.cpu_seconds);
  json("megabytes", record.megabytes);
  json("result", record.result);
}

std::string to_line(const Record& record) {
  return json_text(record);
}

std::optional<Record> record_from(const std::string& line) {
  try {
    return from_json_text<Record>(line, "a record");
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace carlo::grader
