#include "grader/judge/judge.h"

#include "grader/judge/run.h"

#include <catch2/catch_message.hpp>
#include <catch2/catch_test_case_info.hpp>
#include <catch2/reporters/catch_reporter_event_listener.hpp>
#include <catch2/reporters/catch_reporter_registrars.hpp>
#include <catch2/reporters/catch_reporter_streaming_base.hpp>

namespace carlo::grader {
namespace {

/// Notifies the run when a test case begins and ends.
class Follower : public Catch::EventListenerBase {
 public:
  using EventListenerBase::EventListenerBase;

  void testCaseStarting(const Catch::TestCaseInfo& info) override {
    std::vector<std::string> tags;
    for (const Catch::Tag& tag : info.tags)
      tags.emplace_back(tag.original);
    current_run()->begin_test(info.name, aspect_of(tags));
  }
  void testCaseEnded(const Catch::TestCaseStats& stats) override {
    current_run()->end_test(stats.totals.assertions.failed == 0 && !stats.aborting);
  }
};
CATCH_REGISTER_LISTENER(Follower)

/// Prints nothing: the report is written after the run.
class Silent : public Catch::StreamingReporterBase {
 public:
  using StreamingReporterBase::StreamingReporterBase;
  static std::string getDescription() { return "says nothing"; }
};
CATCH_REGISTER_REPORTER("silent", Silent)

}  // namespace

std::unique_ptr<Run>& current_run() {
  static std::unique_ptr<Run> run;
  return run;
}

Answer probe(const std::string& name, const Params& params, const Shape& shape) {
  return current_run()->probe(name, params, shape);
}

void judge(const Verdict& verdict) {
  current_run()->record(verdict);
  UNSCOPED_INFO(verdict.what << ": " << verdict.measured << "; expected " << verdict.expected
                             << ". " << verdict.certainty);
  CHECK(verdict.passed);
}

void leave_unjudged(const std::string& why) {
  current_run()->leave(why);
}

std::vector<double> column(const Rows& rows, std::size_t index) {
  std::vector<double> values;
  values.reserve(rows.count());
  for (std::size_t row = 0; row < rows.count(); ++row)
    values.push_back(rows.at(row, index));
  return values;
}

}  // namespace carlo::grader
