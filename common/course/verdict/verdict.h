#pragma once

#include "course/verdict/figure.h"
#include "course/verdict/status.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

// What a judge finds, from one comparison up to a lab. Plain data: the judge makes it, JSON carries
// it (verdict_json.h), and what people read are renderings of it: texts (verdict_text.h), pages,
// tables of marks.

/// A typical mistake that values fit.
struct Diagnosis {
  std::string id;        ///< "variance-divided-by-n"
  std::string sentence;  ///< for the student: what it looks like
};

/// What a statistical comparison has seen and how little it can see, both in `unit`. `resolution`
/// is the smallest effect that it catches with power .999 at the level of one comparison.
struct Effect {
  double measured = 0;
  double resolution = 0;
  std::string unit;  ///< empty: that of the values compared
  /// Of a mean: the variance of the values as a part of theory's. Well below 1 where theory gives
  /// an upper bound, and so p-values that are too large. 1 where that is no question.
  double spread = 1;
};

/// The conclusion of one comparison.
struct Verdict {
  bool passed = false;
  std::string what;  ///< the thing compared, in words
  std::string measured;
  std::string expected;
  std::string certainty;             ///< how sure: z, p; empty for exact comparisons
  std::optional<double> p;           ///< for statistical ones: its p-value under a right solution
  std::vector<Diagnosis> diagnoses;  ///< that the values fit
  std::optional<Effect> effect = std::nullopt;  ///< beside p: what calibration compares
  std::optional<Figure> figure = std::nullopt;  ///< of a failed one, where it helps
  std::vector<Diagnosis> looked_for = {};  ///< of a failed one: those, and others that do not fit
};

/// One test case: its verdicts, or what kept the values from coming.
struct TestRecord {
  std::string tag;       ///< "Lab 1.2"
  std::string sentence;  ///< what follows the tag in its name
  std::vector<Verdict> verdicts;
  Status status = Status::failed;  ///< passed only after a verdict, and when all passed
  std::string problem;             ///< why there are no values; empty when there are
  std::string printed;       ///< the start of what the program printed, when there was a problem
  bool skipped = false;      ///< not run, or not judged: another test told what would come
  std::string needs = {};    ///< the tag of another exercise, when that is the one not done
  std::string missing = {};  ///< the function that is not done, as the worker calls it
  Aspect aspect = Aspect::correctness;
  std::size_t lost_lines = 0;  ///< that the program printed beyond `printed`
  bool lacks_line = false;     ///< a crash, and nothing has told in which line
};

/// One exercise: all its test cases, and what follows from them.
struct ExerciseResult {
  std::string tag, title;
  Status status = Status::failed;
  double points = 0;
  int max = 0;
  std::vector<TestRecord> tests;
  std::vector<Diagnosis> diagnoses;  ///< that are told, the likeliest first
  std::vector<std::string> unsound;  ///< tags of those it builds on that are not right
  std::vector<std::string> missing;  ///< its functions that tests found not done, as in lab.json
  bool begun = false;                ///< not done, but a part of it is

  /// "1.2": the tag as it is typed on a command line.
  std::string number() const { return tag.substr(4); }
  /// Whether there are tests of this aspect, and whether all of them passed.
  bool has(Aspect aspect) const;
  bool passed(Aspect aspect) const;
};

struct LabResult {
  int lab = 0;
  std::string title;
  bool whole = true;  ///< all its exercises were judged
  std::vector<ExerciseResult> exercises;
  std::uint64_t seed = 0;
  bool usual_seed = false;  ///< the one that a run has that is told none
  std::string sandbox;
  bool cut = false;  ///< verdicts are missing that would have made its JSON too large

  double earned() const;
  int possible() const;
};

/// Points for people: "2", "1.5", "0.75".
std::string points_text(double points);

}  // namespace carlo
