#include "grader/judge/run.h"

#include "course/verdict/printed.h"
#include "grader/judge/compare.h"
#include "grader/judge/crash.h"
#include "grader/judge/numbers.h"
#include "random/hash.h"
#include "support/error.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

namespace carlo::grader {
namespace {

std::string shape_text(std::size_t rows, std::size_t columns) {
  return fmt::format("{} x {} values", rows, columns);
}

/// Adds the program's own output to the failure.
ProbeFailure printing(ProbeFailure failure, const Outcome& outcome) {
  failure.printed = without_reports(outcome.output);
  failure.lost_lines = outcome.lost_lines;
  return failure;
}

void check_rows(const Rows& rows, const Shape& shape) {
  if (rows.count() != shape.rows || rows.columns != shape.columns) {
    throw ProbeFailure(Status::failed, fmt::format("it returned {}, expected {}",
                                                   shape_text(rows.count(), rows.columns),
                                                   shape_text(shape.rows, shape.columns)));
  }
  if (!shape.finite) return;
  const auto bad = std::find_if(rows.values.begin(), rows.values.end(),
                                [](double value) { return !std::isfinite(value); });
  if (bad == rows.values.end()) return;
  const auto row = static_cast<std::size_t>(bad - rows.values.begin()) / rows.columns;
  throw ProbeFailure(
      Status::failed,
      fmt::format(
          "it returned {}{}", std::isnan(*bad) ? "NaN" : "an infinite value",
          rows.count() > 1 ? fmt::format(", in answer {} of {}", row + 1, rows.count()) : ""));
}

/// The names of parameters that mean nothing to a student.
std::set<std::string>& unsaid() {
  static std::set<std::string> names{"repetitions", "points"};
  return names;
}

/// Describes what a probe was asked: in the check's words, or by its parameters.
std::string question(const Params& params, const Shape& shape) {
  if (!shape.of.empty()) return shape.of;
  std::string text;
  const auto add = [&](const std::string& name, const std::string& value) {
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, value);
  };
  for (const auto& [name, value] : params.numbers) {
    if (unsaid().count(name) == 0) add(name, number_in_report(value));
  }
  if (params.n != 0) add("n", number_in_report(static_cast<double>(params.n)));
  return text;
}

/// Says why the tests after one that ended so are not run.
std::string why_hopeless(Status status) {
  return status == Status::not_implemented
             ? "your code called a function that is not implemented yet"
             : "your code took too long";
}

/// Attempts for a probe for which the machine may have lacked resources.
constexpr int most_attempts = 4;

/// The longest name of a function, which its author chooses.
constexpr std::size_t longest_name = 200;

ProbeFailure undone(const Frame& frame) {
  ProbeFailure failure(Status::not_implemented, "not implemented yet");
  constexpr std::size_t longest_tag = 20;
  const bool named = frame.tag.starts_with("Lab ") && frame.tag.size() < longest_tag;
  failure.not_implemented = named ? frame.tag : "";
  failure.function = clipped(frame.function, longest_name);
  return failure;
}

/// Makes the failure of a crash; most lack a sanitizer's report, which names the line.
ProbeFailure crashed(const Outcome& outcome) {
  ProbeFailure failure(Status::crashed, fmt::format("it crashed: {}", crash_cause(outcome)));
  failure.lacks_line = place_in_report(outcome.output).empty();
  return printing(std::move(failure), outcome);
}

/// Guesses what kept it from ending. Many threads in loops run little each.
std::string guess(const Outcome& outcome) {
  const double ran = std::max(outcome.ran, outcome.pressure.worked);
  if (ran >= .3 * (outcome.seconds - outcome.waited)) return ": a loop that does not end?";
  return ", mostly idle: is it waiting for input or a lock?";
}

/// Throws unless the worker ended properly.
void check_end(const Outcome& outcome, const Limits& limits) {
  using End = Outcome::End;
  const auto fail = [&](Status status, const std::string& message) {
    throw printing(ProbeFailure(status, message), outcome);
  };
  switch (outcome.end) {
    case End::exited:
      break;
    case End::signalled:
      throw crashed(outcome);
    case End::deadline:
      fail(Status::timeout,
           fmt::format("it timed out after {:.3g} seconds{}",
                       std::chrono::duration<double>(limits.deadline).count(), guess(outcome)));
      break;
    case End::flooded_output:
      fail(
          Status::crashed,
          fmt::format("it printed more than {} MB, and was stopped: take the printing out of loops",
                      limits.output_bytes >> 20));
      break;
    case End::flooded_result:
      fail(Status::crashed, "it sent more than any answer holds");
      break;
    case End::flooded_disk:
      fail(Status::crashed, "it filled the disk");
      break;
    case End::flooded_memory:
      fail(Status::crashed, fmt::format("its processes took more than {} MB of memory together",
                                        limits.memory_bytes >> 20));
      break;
    case End::flooded_processes:
      fail(Status::crashed,
           fmt::format("it started more than {} threads and processes", limits.processes));
      break;
    case End::starved:
    case End::not_started:
      throw Error("the program could not be run");
  }
  if (outcome.code != 0 && has_report(outcome.output)) {
    throw crashed(outcome);
  }
  if (outcome.code != 0) {
    fail(Status::crashed,
         fmt::format("your code ended the program with exit code {}, by exit() or the like",
                     outcome.code));
  }
  if (outcome.result.empty()) {
    fail(Status::crashed,
         "your code ended the program, by exit() or the like, before the function returned");
  }
}

}  // namespace

Unsaid::Unsaid(std::initializer_list<const char*> names) {
  unsaid().insert(names.begin(), names.end());
}

std::uint64_t word_of(const std::string& text) {
  return mix(hash_of(text));
}

std::uint64_t local_seed() {
  return hash(word_of(public_secret), word_of(local_submission));
}

Answer run_probe(const Worker& worker, const std::string& name, const Params& params,
                 const Shape& shape, const Limits& limits, Charged* charged) {
  Outcome outcome;
  std::optional<Frame> frame;
  // A thread that cannot be started may be the fault of others, whose threads count with ours.
  for (int attempt = 1; attempt <= most_attempts; ++attempt) {
    if (attempt > 1) std::this_thread::sleep_for(std::chrono::milliseconds(250) * attempt);
    outcome = worker.run({"--probe", name, "--params", to_text(params), "--fd", "3"}, limits);
    if (charged != nullptr) *charged = {outcome.seconds - outcome.waited, outcome.pressure};
    check_end(outcome, limits);
    frame = decode(outcome.result);
    if (!frame || frame->status != Frame::Status::exhausted) break;
  }
  if (!frame) throw ProbeFailure(Status::crashed, "no complete answer came back from your code");
  if (frame->status == Frame::Status::not_implemented) {
    throw undone(*frame);
  }
  if (frame->status == Frame::Status::exhausted) {
    throw Error(
        "a thread could not be started in {} attempts: the code starts too many, or the machine is full",
        most_attempts);
  }
  if (frame->status == Frame::Status::error) {
    throw printing(
        ProbeFailure(Status::crashed, "it threw an exception: " + frame->text.substr(0, 500)),
        outcome);
  }
  check_rows(frame->rows, shape);
  return {std::move(frame->rows), params.seed, outcome.seconds};
}

void Run::begin_test(const std::string& name, Aspect aspect) {
  const auto colon = name.find(": ");
  if (colon == std::string::npos) throw Error("the test \"{}\" names no exercise", name);
  TestRecord record;
  record.tag = name.substr(0, colon);
  record.sentence = name.substr(colon + 2);
  record.aspect = aspect;
  records_.push_back(record);
  probes_in_test_ = 0;
}

TestRecord& Run::current() {
  if (records_.empty()) throw Error("a verdict outside of any test");
  return records_.back();
}

void Run::end_test(bool clean) {
  TestRecord& test = current();
  const bool all_passed = std::all_of(test.verdicts.begin(), test.verdicts.end(),
                                      [](const Verdict& verdict) { return verdict.passed; });
  if (!test.problem.empty()) return;
  if (test.verdicts.empty()) {
    test.problem = "the grader came to no verdict: please report this";
  } else if (all_passed && !clean) {
    test.problem = "the grader itself failed: please report this";
  } else if (all_passed) {
    test.status = Status::passed;
  }
}

const TestRecord* Run::hopeless(const std::string& tag) const {
  const auto found = std::find_if(records_.begin(), records_.end(), [&](const TestRecord& test) {
    const bool too_slow = test.status == Status::timeout && test.aspect == Aspect::correctness;
    const bool open = test.status == Status::not_implemented && in_parts_.count(tag) == 0;
    return test.tag == tag && !test.skipped && (open || too_slow);
  });
  return found == records_.end() ? nullptr : &*found;
}

void Run::check_time(TestRecord& test) const {
  const double deadline = static_cast<double>(limits_.deadline.count()) / 1000;
  const auto found = seconds_of_.find(test.tag);
  const bool exercise = found != seconds_of_.end() && found->second > exercise_deadlines * deadline;
  if (!exercise && seconds_ <= lab_deadlines * deadline) return;
  // Short probes spend much of their time starting.
  if (pressure_.is_high()) throw Error("the machine was too busy to tell how long the probes take");
  test.skipped = true;
  throw ProbeFailure(
      Status::timeout,
      fmt::format("not run: the tests of {} have taken {:.0f} seconds together",
                  exercise ? "this exercise" : "this lab", exercise ? found->second : seconds_));
}

Answer Run::probe(const std::string& name, Params params, const Shape& shape) {
  TestRecord& test = current();
  params.seed = hash(seed_, word_of(test.tag + ": " + test.sentence), probes_in_test_++);
  const std::string asked = question(params, shape);
  asked_.push_back(
      {test.tag, test.sentence, name, params, asked, shape.rows, shape.columns, Status::passed});
  Charged charged;
  if (!trouble_.empty()) throw Error("{}", trouble_);
  try {
    if (const TestRecord* earlier = hopeless(test.tag)) {
      test.skipped = true;
      throw ProbeFailure(
          earlier->status,
          fmt::format("not run: {} in \"{}\"", why_hopeless(earlier->status), earlier->sentence));
    }
    check_time(test);
    Answer answer = run_probe(worker_, name, params, shape, limits_, &charged);
    charge(charged);
    return answer;
  } catch (const ProbeFailure& failure) {
    charge(charged);
    asked_.back().status = failure.status;
    asked_.back().problem = failure.what();
    note(failure, asked);
    throw;
  } catch (const std::exception& error) {
    trouble_ = error.what();
    throw;
  }
}

void Run::charge(const Charged& charged) {
  seconds_ += charged.seconds;
  seconds_of_[current().tag] += charged.seconds;
  pressure_ += charged.pressure;
}

void Run::note(const ProbeFailure& failure, const std::string& question) {
  TestRecord& test = current();
  test.status = failure.status;
  test.problem = failure.what();
  test.printed = failure.printed;
  test.lost_lines = failure.lost_lines;
  test.lacks_line = failure.lacks_line;
  if (failure.status == Status::not_implemented) {
    if (failure.not_implemented != test.tag) test.needs = failure.not_implemented;
    test.missing = failure.function;
  } else if (!test.skipped && !question.empty()) {
    test.problem += fmt::format(" ({})", question);
  }
}

void Run::leave(const std::string& why) {
  current().skipped = true;
  current().problem = why;
}

void Run::record(const Verdict& verdict) {
  if (verdict.p && ++statistical_ > lab_budget) {
    trouble_ = fmt::format("more than {} statistical comparisons: their error rate is not kept",
                           lab_budget);
    throw Error("{}", trouble_);
  }
  current().verdicts.push_back(verdict);
}

}  // namespace carlo::grader
