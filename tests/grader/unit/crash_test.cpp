// Tests what a student learns about a crash: its cause, and the line if a sanitizer knows it.

#include "grader/judge/crash.h"

#include <catch2/catch_test_macros.hpp>

#include <csignal>
#include <string>

using namespace carlo::grader;

namespace {

Outcome crash(const std::string& said) {
  Outcome outcome;
  outcome.end = Outcome::End::signalled;
  outcome.code = SIGABRT;
  outcome.output = said;
  return outcome;
}

const std::string assertion =
    "/usr/include/c++/12/bits/stl_vector.h:1123: std::vector<double>::operator[](size_type): "
    "Assertion '__n < this->size()' failed.\n";
const std::string report =
    "=================================================================\n"
    "==7==ERROR: AddressSanitizer: heap-buffer-overflow on address 0x6020 at pc 0x55\n"
    "    #0 0x55 in std::vector<double>::operator[] /usr/include/c++/12/bits/stl_vector.h:1123\n"
    "    #1 0x56 in lab01::average(long) /tree/labs/01_integration/integration.cpp:27\n"
    "    #2 0x57 in probe /tree/tests/01_integration/probes_average.cpp:9\n";

}  // namespace

TEST_CASE("a crash is told by its signal, the library's check or the sanitizer's report",
          "[report]") {
  CHECK(crash_cause(crash("")) == signal_name(SIGABRT));
  CHECK(crash_cause(crash(assertion)) == "an index outside of its vector, array or span");
  CHECK(crash_cause(crash(report)) ==
        "heap-buffer-overflow, in labs/01_integration/integration.cpp:27");
  CHECK(crash_cause(crash(assertion + report)) ==
        "an index outside of its vector, array or span, in labs/01_integration/integration.cpp:27");
  CHECK(crash_cause(crash("/tree/labs/02_pi/pi.cpp:9:3: runtime error: division by zero\n")) ==
        "division by zero, in labs/02_pi/pi.cpp:9");
  CHECK(crash_cause(
            crash("labs/02_pi/pi.cpp:9:3: runtime error: a function ended without a return\n")) ==
        "a function ended without a return, in labs/02_pi/pi.cpp:9");
  Outcome illegal = crash("");
  illegal.code = SIGILL;
  CHECK(crash_cause(illegal) == "illegal instruction");
  Outcome deep = crash("the stack is full: 8 MB\n");
  deep.code = SIGSEGV;
  CHECK(crash_cause(deep) ==
        "the stack is full (8 MB): a recursion goes too deep, or a local array is too large; use a "
        "loop, or a std::vector");
  // Only a bad access can come from it.
  CHECK(crash_cause(crash(deep.output)) == signal_name(SIGABRT));
  // A program's own output about itself is no report.
  CHECK(crash_cause(crash("labs/02_pi/pi.cpp:9\n")) == signal_name(SIGABRT));
}

TEST_CASE("an exception that nobody catches is told as such", "[report]") {
  const std::string thrown =
      "terminate called after throwing an instance of 'std::domain_error'\n"
      "  what():  a sample went wrong\n";
  const std::string cause = "an exception (std::domain_error: a sample went wrong) left a thread's";
  CHECK(crash_cause(crash(thrown)).rfind(cause, 0) == 0);
  const std::string in_debug =
      thrown + "AddressSanitizer:DEADLYSIGNAL\n" +
      "==7==ERROR: AddressSanitizer: ABRT on unknown address 0x3e8 (pc 0x7f)\n"
      "    #9 0x56 in work /tree/labs/02_pi/pi.cpp:80\n";
  CHECK(crash_cause(crash(in_debug)).rfind(cause, 0) == 0);
  CHECK(place_in(crash_cause(crash(in_debug))) == "labs/02_pi/pi.cpp:80");
  CHECK(without_reports("i = 3\n" + in_debug) == "i = 3\n");
  const std::string no_words = "terminate called after throwing an instance of 'int'\n";
  CHECK(crash_cause(crash(no_words)).rfind("an exception (int) left", 0) == 0);
  const std::string unjoined = "terminate called without an active exception\n";
  CHECK(crash_cause(crash(unjoined)).find("without join() or detach()") != std::string::npos);
  CHECK(without_reports(unjoined).empty());
}

TEST_CASE("what a program said itself is kept, reports are not", "[report]") {
  CHECK(without_reports("i = 3\n" + assertion + "AddressSanitizer:DEADLYSIGNAL\n" + report) ==
        "i = 3\n");
  CHECK(without_reports("i = 3\n====\nj = 4\n") == "i = 3\n====\nj = 4\n");
  CHECK(without_reports("x.cpp:1:1: runtime error: overflow\nmore\n").empty());
}
