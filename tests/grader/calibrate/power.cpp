#include "grader/calibrate/power.h"

#include "grader/judge/compare.h"

#include <cmath>
#include <limits>
#include <map>

namespace carlo::grader {
namespace {

/// Returns what each comparison measured of one mistake.
std::map<ComparisonName, Sight> sights(const Judged& mistake) {
  std::map<ComparisonName, Sight> result;
  for (const Record* record : mistake.records) {
    for (const auto& [name, p, seen] : comparisons(*record)) {
      Sight& sight = result[name];
      const double effect = std::abs(seen.measured);
      sight.mistake = mistake.subject.what;
      // Values that are not numbers are as wrong as can be.
      sight.effect += std::isnan(effect) ? std::numeric_limits<double>::infinity() : effect;
      sight.runs += 1;
      sight.caught += p >= comparison_alpha() ? 0 : 1;
    }
  }
  for (auto& [name, sight] : result)
    sight.effect /= static_cast<double>(sight.runs);
  return result;
}

void add(const Sight& sight, PowerFinding& finding) {
  if (sight.effect >= finding.comparison.resolution) {
    finding.runs_in_sight += sight.runs;
    finding.caught_in_sight += sight.caught;
  }
  if (sight.caught == 0) return;
  if (finding.mistakes_caught == 0 || sight.effect < finding.weakest.effect) {
    finding.weakest = sight;
  }
  ++finding.mistakes_caught;
}

}  // namespace

std::vector<PowerFinding> power_findings(const LabFinding& lab,
                                         const std::vector<Judged>& mistakes) {
  std::vector<PowerFinding> findings;
  std::map<ComparisonName, std::size_t> places;
  for (const ComparisonFinding& comparison : lab.comparisons) {
    places[comparison.name] = findings.size();
    findings.push_back({lab.lab, comparison, 0, {}, 0, 0});
  }
  for (const Judged& mistake : mistakes) {
    if (mistake.subject.lab != lab.lab) continue;
    for (const auto& [name, sight] : sights(mistake)) {
      const auto place = places.find(name);
      if (place != places.end()) add(sight, findings[place->second]);
    }
  }
  return findings;
}

}  // namespace carlo::grader
