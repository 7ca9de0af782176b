#pragma once

#include "grader/judge/asked.h"
#include "grader/judge/results.h"
#include "grader/judge/worker.h"
#include "grader/protocol/frame.h"
#include "grader/protocol/params.h"

#include <cstdint>
#include <initializer_list>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace carlo::grader {

/// The table that a probe must return. `finite`: infinities and NaN are a fail.
struct Shape {
  std::size_t rows = 1;
  std::size_t columns = 1;
  bool finite = true;
  std::string of = {};  ///< what the probe is asked, for messages; empty: its parameters tell
};

/// Why a probe returned no usable values.
struct ProbeFailure : std::runtime_error {
  ProbeFailure(Status status_, const std::string& message, std::string printed_ = {})
      : std::runtime_error(message), status(status_), printed(std::move(printed_)) {}
  Status status;
  std::string printed;
  std::string not_implemented = {};  ///< the tag of the exercise that is not done
  std::string function = {};         ///< and the function, without its class
  std::size_t lost_lines = 0;        ///< that it printed beyond `printed`
  bool lacks_line = false;           ///< it crashed, and nothing tells in which line
};

/// The table that a probe returned, and what the judge itself knows of it. The table may be forged;
/// with the seed a check works out what it should hold, and no time in it can exceed `seconds`.
struct Answer : Rows {
  std::uint64_t seed = 0;  ///< that the probe was given
  double seconds = 0;      ///< wall clock, from the worker's start to its end
};

/// What a probe took: the seconds that count against deadlines, and what the machine was like.
struct Charged {
  double seconds = 0;
  Pressure pressure = {};
};

/// Runs one probe in a fresh worker. Throws ProbeFailure unless exactly the table of `shape` comes
/// back, in time, from a worker that then ends well. Throws Error where it is not to blame: the
/// program could not be run, or a thread could not be started, in several attempts.
/// `charged`, where it is given, is set also when it throws.
Answer run_probe(const Worker& worker, const std::string& name, const Params& params,
                 const Shape& shape, const Limits& limits, Charged* charged = nullptr);

/// How many deadlines' worth of time the probes of one exercise may take together, and those of the
/// lab: what answers a moment before each deadline must not hold up the grader for hours.
constexpr double exercise_deadlines = 6, lab_deadlines = 36;

/// Says of parameters of a lab's probes that they tell a student nothing: how often the same is
/// asked, or which of the probe's own cases is meant. A lab's checks have one at namespace scope.
struct Unsaid {
  Unsaid(std::initializer_list<const char*> names);
};

/// One judgement of a lab: what the test cases have found so far.
class Run {
 public:
  Run(Worker worker, std::uint64_t seed, Limits limits)
      : worker_(std::move(worker)), seed_(seed), limits_(limits) {}

  /// Of the exercise of this tag a part may be done while another is not: all its tests run.
  void has_parts(const std::string& tag) { in_parts_.insert(tag); }

  void begin_test(const std::string& name, Aspect aspect = Aspect::correctness);
  /// `clean`: the test framework saw no failure.
  void end_test(bool clean);

  /// A probe of the current test; its seed follows from the run's, the test's name and the number
  /// of probes before it. A failure is noted and ends the test. Once an exercise is known to be not
  /// implemented (unless it has parts) or to run into the deadline, or has used up its time, its
  /// probes are not started any more; but what is too slow where only its cost is judged may still
  /// be right.
  Answer probe(const std::string& name, Params params, const Shape& shape);

  /// Notes a verdict. Throws Error when the budget of statistical ones is used up.
  void record(const Verdict& verdict);

  /// Leaves the current test without a verdict; it has not passed. For one that would judge what
  /// another test has found wrong. `why`: "not judged: ...".
  void leave(const std::string& why);

  /// What kept a worker from running that is no fault of its program; then nothing is judged any
  /// more. Empty: nothing.
  const std::string& trouble() const { return trouble_; }

  const std::vector<TestRecord>& records() const { return records_; }
  /// All questions so far, those that were not put to a worker any more too.
  const std::vector<Asked>& asked() const { return asked_; }
  std::uint64_t seed() const { return seed_; }
  const Sandbox& sandbox() const { return worker_.sandbox(); }

 private:
  TestRecord& current();
  void check_time(TestRecord& test) const;
  void charge(const Charged& charged);
  void note(const ProbeFailure& failure, const std::string& question);
  const TestRecord* hopeless(const std::string& tag) const;

  Worker worker_;
  std::uint64_t seed_;
  Limits limits_;
  std::vector<TestRecord> records_;
  std::vector<Asked> asked_;
  std::set<std::string> in_parts_;
  std::uint64_t probes_in_test_ = 0;
  int statistical_ = 0;
  std::map<std::string, double> seconds_of_;  ///< charged to the probes of an exercise, by tag
  double seconds_ = 0;                        ///< charged to all
  Pressure pressure_;                         ///< while they ran
  std::string trouble_;
};

/// What seeds follow from where nobody says otherwise: a secret that is none, and the submission.
constexpr const char* public_secret = "public";
constexpr const char* local_submission = "local";

/// The seed of a run that is told no other, which a student's own machine has.
std::uint64_t local_seed();

/// A word from a text (FNV-1a, then mixed): seeds follow from names.
std::uint64_t word_of(const std::string& text);

}  // namespace carlo::grader
