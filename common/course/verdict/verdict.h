#pragma once

#include "course/verdict/figure.h"
#include "course/verdict/status.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

// A judge's findings, from a single comparison up to a lab. Plain data: the judge makes it, JSON
// carries it (verdict_json.h), and texts (verdict_text.h), pages and tables of marks present it to
// people.

/// A typical mistake that explains the values.
struct Diagnosis {
  std::string id;        ///< "variance-divided-by-n"
  std::string sentence;  ///< for the student: what it looks like
};

/// The effect that a statistical comparison measured and the smallest it can detect, both in
/// `unit`: `resolution` is detected with power .999 at the level of one comparison.
struct Effect {
  double measured = 0;
  double resolution = 0;
  std::string unit;  ///< empty: that of the compared values
  /// For a mean: the variance of the values relative to theory's. Well below 1 where theory gives
  /// only an upper bound, which makes p-values too large. 1 if not applicable.
  double spread = 1;
};

/// The conclusion of one comparison.
struct Verdict {
  bool passed = false;
  std::string what;  ///< what was compared, in words
  std::string measured;
  std::string expected;
  std::string certainty;             ///< how sure: z, p; empty for exact comparisons
  std::optional<double> p;           ///< if statistical: its p-value under a right solution
  std::vector<Diagnosis> diagnoses;  ///< that explain the values
  std::optional<Effect> effect = std::nullopt;  ///< set if p is: used by calibration
  std::optional<Figure> figure = std::nullopt;  ///< only if failed, and if it helps
  std::vector<Diagnosis> looked_for = {};       ///< only if failed: fitting ones and others
};

/// One test case: its verdicts, or why no values came.
struct TestRecord {
  std::string tag;       ///< "Lab 1.2"
  std::string sentence;  ///< the part of its name after the tag
  std::vector<Verdict> verdicts;
  Status status = Status::failed;  ///< passed only if there are verdicts and all passed
  std::string problem;             ///< why there are no values; empty if there are
  std::string printed;       ///< the start of what the program printed, if there was a problem
  bool skipped = false;      ///< not run, or not judged: another test settled the outcome
  std::string needs = {};    ///< the tag of another exercise, if that is the one not done
  std::string missing = {};  ///< the function that is not done, as the worker calls it
  Aspect aspect = Aspect::correctness;
  std::size_t lost_lines = 0;  ///< lines that the program printed beyond `printed`
  bool lacks_line = false;     ///< a crash whose line is not known
};

/// An exercise judged once more, with the suite's versions of those that it builds on and that are
/// not right: a mistake there costs no points here. Holds only what the judge itself says, and no
/// number: a student's program could write the suite's code, beside which it runs, into measured
/// values.
struct ByItself {
  Status status = Status::failed;
  double points = 0;
  std::vector<std::string> replaced;       ///< tags of these exercises
  std::vector<Diagnosis> diagnoses = {};   ///< likeliest first
  std::vector<std::string> failures = {};  ///< the sentences of tests that failed
};

/// One exercise: all its test cases, and their result.
struct ExerciseResult {
  std::string tag, title;
  Status status = Status::failed;
  double points = 0;  ///< of the better judgement
  int max = 0;
  std::vector<TestRecord> tests;
  std::vector<Diagnosis> diagnoses;  ///< those shown, likeliest first
  std::vector<std::string> unsound;  ///< tags of those it builds on that are not right
  std::vector<std::string> missing;  ///< its functions that tests found not done, as in lab.json
  bool begun = false;                ///< not done, but partly written
  std::optional<ByItself> by_itself = std::nullopt;  ///< the second judgement, if there was one

  /// Returns "1.2": the tag as typed on a command line.
  std::string number() const { return tag.substr(4); }
  /// Return whether there are tests of this aspect, and whether all of them passed.
  bool has(Aspect aspect) const;
  bool passed(Aspect aspect) const;
  /// Whether it earns all its points by the second judgement alone.
  bool right_by_itself() const;
  /// The likely causes of its own failure, likeliest first: those of the second judgement if there
  /// was one, for the first one's may be another exercise's.
  const std::vector<Diagnosis>& causes() const;
};

struct LabResult {
  int lab = 0;
  std::string title;
  bool whole = true;  ///< all its exercises were judged
  std::vector<ExerciseResult> exercises;
  std::uint64_t seed = 0;
  bool usual_seed = false;  ///< the default seed
  std::string sandbox;
  bool cut = false;  ///< verdicts are missing that would have made its JSON too large

  double earned() const;
  int possible() const;
};

/// Formats points for people: "2", "1.5", "0.75".
std::string points_text(double points);

}  // namespace carlo
