// Chooses which of the typical mistakes named by single comparisons the student sees.

#include "grader/judge/results.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace carlo::grader {
namespace {

/// One diagnosis with its evidence: the failed comparisons that it explains, and how many of those
/// that looked for it found something else.
struct Candidate {
  Diagnosis diagnosis;
  std::vector<std::size_t> explains;
  int misses = 0;

  int merit() const { return static_cast<int>(explains.size()) - misses; }
  /// Returns whether nothing distinguishes the two.
  bool fits_like(const Candidate& other) const {
    return explains == other.explains && misses == other.misses;
  }
  bool adds_to(const std::vector<bool>& explained) const {
    return std::any_of(explains.begin(), explains.end(),
                       [&](std::size_t i) { return !explained[i]; });
  }
};

bool names(const std::vector<Diagnosis>& diagnoses, const std::string& id) {
  return std::any_of(diagnoses.begin(), diagnoses.end(),
                     [&](const Diagnosis& diagnosis) { return diagnosis.id == id; });
}

std::vector<const Verdict*> failures(const std::vector<TestRecord>& tests) {
  std::vector<const Verdict*> list;
  for (const TestRecord& test : tests) {
    for (const Verdict& verdict : test.verdicts) {
      if (!verdict.passed) list.push_back(&verdict);
    }
  }
  return list;
}

/// Returns the candidates in the order in which they were first named.
std::vector<Candidate> candidates(const std::vector<const Verdict*>& failures) {
  std::vector<Candidate> list;
  for (std::size_t i = 0; i < failures.size(); ++i) {
    for (const Diagnosis& diagnosis : failures[i]->diagnoses) {
      const auto same = [&](const Candidate& one) { return one.diagnosis.id == diagnosis.id; };
      auto found = std::find_if(list.begin(), list.end(), same);
      if (found == list.end()) found = list.insert(list.end(), {diagnosis, {}, 0});
      if (found->explains.empty() || found->explains.back() != i) found->explains.push_back(i);
    }
  }
  for (Candidate& candidate : list) {
    for (const Verdict* failure : failures) {
      const std::string& id = candidate.diagnosis.id;
      if (names(failure->looked_for, id) && !names(failure->diagnoses, id)) ++candidate.misses;
    }
  }
  return list;
}

}  // namespace

std::vector<Diagnosis> diagnoses(const std::vector<TestRecord>& tests) {
  const std::vector<const Verdict*> failed = failures(tests);
  std::vector<Candidate> likely = candidates(failed);
  std::stable_sort(likely.begin(), likely.end(),
                   [](const Candidate& a, const Candidate& b) { return a.merit() > b.merit(); });
  std::vector<Diagnosis> told;
  std::vector<bool> explained(failed.size(), false);
  for (const Candidate& candidate : likely) {
    const bool surely = candidate.misses == 0 && candidate.adds_to(explained);
    if (!told.empty() && !surely && !candidate.fits_like(likely.front())) continue;
    told.push_back(candidate.diagnosis);
    for (const std::size_t i : candidate.explains)
      explained[i] = true;
  }
  return told;
}

}  // namespace carlo::grader
