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

/// The expected table of a probe. `finite`: infinities and NaN are a fail.
struct Shape {
  std::size_t rows = 1;
  std::size_t columns = 1;
  bool finite = true;
  std::string of = {};  ///< the question, for messages; empty: its parameters
};

/// Why a probe returned no usable values.
struct ProbeFailure : std::runtime_error {
  ProbeFailure(Status status_, const std::string& message, std::string printed_ = {})
      : std::runtime_error(message), status(status_), printed(std::move(printed_)) {}
  Status status;
  std::string printed;
  std::string not_implemented = {};  ///< tag of the exercise that is not done
  std::string function = {};         ///< its function, without the class
  std::size_t lost_lines = 0;        ///< lines printed beyond `printed`
  bool lacks_line = false;           ///< it crashed, and its line is unknown
};

/// The table that a probe returned, with the judge's own data about it. The table may be forged;
/// from the seed a check can compute what it should hold, and no time in it can exceed `seconds`.
struct Answer : Rows {
  std::uint64_t seed = 0;  ///< given to the probe
  double seconds = 0;      ///< wall clock, from the worker's start to its end
};

/// The cost of a probe: the seconds that count against deadlines, and how busy the machine was.
struct Charged {
  double seconds = 0;
  Pressure pressure = {};
};

/// Runs one probe in a new worker. Throws ProbeFailure unless exactly the table of `shape` comes
/// back, in time, from a worker that then ends properly. Throws Error if the worker is not to
/// blame: the program could not be run, or a thread could not be started, in several attempts. Sets
/// `charged`, if given, even when it throws.
Answer run_probe(const Worker& worker, const std::string& name, const Params& params,
                 const Shape& shape, const Limits& limits, Charged* charged = nullptr);

/// How many deadlines the probes of one exercise may take together, and those of the lab: answers
/// just before each deadline must not hold up the grader for hours.
constexpr double exercise_deadlines = 6, lab_deadlines = 36;

/// Declares parameters of a lab's probes that mean nothing to a student: how often something is
/// repeated, or which of the probe's own cases is meant. A lab's checks have one at namespace
/// scope.
struct Unsaid {
  Unsaid(std::initializer_list<const char*> names);
};

/// One judgement of a lab: the results of the test cases so far.
class Run {
 public:
  Run(Worker worker, std::uint64_t seed, Limits limits)
      : worker_(std::move(worker)), seed_(seed), limits_(limits) {}

  /// A part of the exercise of this tag may be done while another is not: runs all its tests.
  void has_parts(const std::string& tag) { in_parts_.insert(tag); }

  void begin_test(const std::string& name, Aspect aspect = Aspect::correctness);
  /// `clean`: the test framework saw no failure.
  void end_test(bool clean);

  /// Runs a probe for the current test; its seed follows from the run's, the test's name and the
  /// number of probes before it. A failure is recorded and ends the test. Once an exercise is known
  /// to be not implemented (unless it has parts) or to exceed the deadline, or has used up its
  /// time, its probes are no longer started; but what is too slow where only its cost is judged may
  /// still be right.
  Answer probe(const std::string& name, Params params, const Shape& shape);

  /// Records a verdict. Throws Error if the budget of statistical ones is used up.
  void record(const Verdict& verdict);

  /// Leaves the current test without a verdict and not passed, because another test has already
  /// found wrong what it would judge. `why`: "not judged: ...".
  void leave(const std::string& why);

  /// What kept a worker from running through no fault of its program; nothing more is judged then.
  /// Empty: nothing.
  const std::string& trouble() const { return trouble_; }

  const std::vector<TestRecord>& records() const { return records_; }
  /// All questions so far, including those that were no longer put to a worker.
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
  std::map<std::string, double> seconds_of_;  ///< charged to the probes of each exercise, by tag
  double seconds_ = 0;                        ///< charged to all
  Pressure pressure_;                         ///< while they ran
  std::string trouble_;
};

/// What seeds follow from by default: a public "secret", and the submission.
constexpr const char* public_secret = "public";
constexpr const char* local_submission = "local";

/// Returns the default seed of a run, which a student's own machine uses.
std::uint64_t local_seed();

/// Hashes a text to a word (FNV-1a, then mixed): seeds follow from names.
std::uint64_t word_of(const std::string& text);

/// The run that test cases report to: Catch2 calls them without arguments, so it must be reachable
/// from anywhere. main() creates it before the first test case starts.
std::unique_ptr<Run>& current_run();

}  // namespace carlo::grader
