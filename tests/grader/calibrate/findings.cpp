#include "grader/calibrate/findings.h"

#include "course/verdict/verdict_text.h"
#include "grader/judge/compare.h"
#include "stats/distributions.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace carlo::grader {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Where the variance of values is below this part of theory's, theory gives only a bound: 2000
/// values or more determine it to a few per cent.
constexpr double bound = .9;

/// The number of diagnoses that a report shows: a mistake further down is not named.
constexpr std::size_t shown_diagnoses = 2;

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void add_costs(const Judged& judged, LabFinding& finding) {
  std::vector<double> seconds;
  for (const Record* record : judged.records) {
    seconds.push_back(record->cpu_seconds);
    finding.worst_seconds = std::max(finding.worst_seconds, record->cpu_seconds);
    finding.worst_megabytes = std::max(finding.worst_megabytes, record->megabytes);
  }
  finding.median_seconds = median(seconds);
}

void add_failure(const Record& record, LabFinding& finding) {
  ++finding.false_failures;
  for (const ExerciseResult& exercise : record.result.exercises) {
    if (exercise.status == Status::passed) continue;
    finding.failures.push_back(fmt::format("seed {}, {} is \"{}\": {}", record.key.seed,
                                           exercise.tag, to_string(exercise.status),
                                           message(exercise)));
  }
}

/// Returns the informative p-values: only one of a comparison whose numbers do not depend on the
/// grading's seed and so are the same each time.
std::vector<double> telling(const std::vector<double>& p) {
  const bool fixed = std::all_of(p.begin(), p.end(), [&](double x) { return x == p.front(); });
  return fixed && !p.empty() ? std::vector<double>{p.front()} : p;
}

void add_uniformity(LabFinding& finding) {
  const double level =
      sidak(uniformity_level, std::max<std::size_t>(1, finding.comparisons.size()));
  std::vector<double> all, without_cautious;
  for (ComparisonFinding& comparison : finding.comparisons) {
    const std::vector<double> p = telling(comparison.p_values);
    comparison.uniformity = uniformity(p);
    all.insert(all.end(), p.begin(), p.end());
    if (comparison.behaviour(level) == Behaviour::cautious) continue;
    without_cautious.insert(without_cautious.end(), p.begin(), p.end());
  }
  finding.all = uniformity(all);
  finding.without_cautious = uniformity(without_cautious);
}

}  // namespace

Behaviour ComparisonFinding::behaviour(double level) const {
  const Behaviour shown = uniformity.behaviour(level);
  return shown == Behaviour::uniform && spread < bound ? Behaviour::cautious : shown;
}

std::string ComparisonFinding::caution() const {
  if (spread < bound) {
    return fmt::format("theory's variance is a bound, the values have {:.2g} of it", spread);
  }
  return uniformity.ties ? "it takes few values" : "";
}

LabFinding lab_finding(const Judged& solution) {
  LabFinding finding;
  finding.lab = solution.subject.lab;
  finding.gradings = solution.records.size();
  std::map<ComparisonName, std::size_t> places;
  for (const Record* record : solution.records) {
    if (record->exit_code != 0) add_failure(*record, finding);
    for (const auto& [name, p, effect] : comparisons(*record)) {
      const auto [place, fresh] = places.emplace(name, finding.comparisons.size());
      if (fresh) {
        finding.comparisons.push_back(
            {name, {}, effect.resolution, effect.unit, {}, effect.spread});
      }
      finding.comparisons[place->second].p_values.push_back(p);
    }
  }
  add_uniformity(finding);
  add_costs(solution, finding);
  return finding;
}

namespace {

/// Returns how far below the level the clearest failed comparison of a run lies, in orders of
/// magnitude.
double margin(const Record& record) {
  if (exact_failures(record.result.exercises.front()) > 0) return infinite;
  double best = -infinite;
  for (const Comparison& comparison : comparisons(record)) {
    const double p = std::isnan(comparison.p) ? 0 : comparison.p;
    best = std::max(best, std::log10(comparison_alpha()) - std::log10(p));
  }
  return best;
}

bool is_named(const Subject& subject, const ExerciseResult& exercise) {
  if (subject.diagnosis == "crash") return exercise.status == Status::crashed;
  const auto& told = exercise.diagnoses;
  const auto end =
      told.begin() + static_cast<std::ptrdiff_t>(std::min(told.size(), shown_diagnoses));
  return exercise.status == Status::failed && std::any_of(told.begin(), end, [&](const auto& one) {
           return one.id == subject.diagnosis;
         });
}

}  // namespace

MistakeFinding mistake_finding(const Judged& mistake) {
  MistakeFinding finding;
  finding.subject = mistake.subject;
  finding.margin = infinite;
  for (const Record* record : mistake.records) {
    if (record->result.exercises.empty()) continue;
    const ExerciseResult& exercise = record->result.exercises.front();
    const bool failed = exercise.status != Status::passed;
    const bool named = is_named(mistake.subject, exercise);
    ++finding.runs;
    finding.caught += failed ? 1 : 0;
    const bool alone = named && exercise.diagnoses.size() <= 1;
    finding.named += named ? 1 : 0;
    finding.alone += alone ? 1 : 0;
    finding.margin = std::min(finding.margin, margin(*record));
    if (!alone && finding.first_missed.empty()) {
      finding.first_missed =
          fmt::format("seed {}: {}", record->key.seed, to_string(exercise.status));
      for (const Diagnosis& diagnosis : exercise.diagnoses)
        finding.first_missed += ", " + diagnosis.id;
    }
  }
  return finding;
}

}  // namespace carlo::grader
