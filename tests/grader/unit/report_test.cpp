#include "course/verdict/verdict_text.h"
#include "grader/judge/compare.h"
#include "grader/judge/results.h"
#include "grader/judge/run.h"
#include "places.h"
#include "support/error.h"
#include "texts.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>

#include <string>

using namespace carlo;
using namespace carlo::grader;

namespace {

carlo::Lab demo_lab() {
  return {
      1,
      "demo",
      "Demo",
      {{"Lab 1.1", "First", 2, {"f"}, {"a", "b"}}, {"Lab 1.2", "Second", 3, {"g"}, {"a", "b"}}}};
}

TestRecord passed(const std::string& tag) {
  return {tag, "it holds", {holds("it", true, "1", "1")}, Status::passed, "", ""};
}

TestRecord failed(const std::string& tag) {
  return {tag,
          "it holds",
          {holds("it", false, "1", "2", {{"off-by-one", "one is missing."}})},
          Status::failed,
          "",
          ""};
}

}  // namespace

TEST_CASE("an exercise earns its points when all its tests pass", "[report]") {
  const carlo::Lab lab = demo_lab();
  CHECK(collect(lab, {passed("Lab 1.1"), passed("Lab 1.2")}, "").earned() == 5);
  CHECK(collect(lab, {passed("Lab 1.1"), failed("Lab 1.1"), passed("Lab 1.2")}, "").earned() == 3);
  const LabResult one = collect(lab, {passed("Lab 1.2")}, "Lab 1.2");
  CHECK(one.earned() == 3);
  CHECK(one.possible() == 3);
}

TEST_CASE("variance and efficiency earn the second half of the points", "[report]") {
  const auto with = [](TestRecord record, Aspect aspect) {
    record.aspect = aspect;
    return record;
  };
  const auto earned = [&](const std::vector<TestRecord>& records) {
    return collect(demo_lab(), records, "Lab 1.1").earned();
  };
  const TestRecord good = passed("Lab 1.1"), bad = failed("Lab 1.1");
  CHECK(earned({good, with(good, Aspect::variance)}) == 2);
  CHECK(earned({good, with(bad, Aspect::variance)}) == 1);
  CHECK(earned({good, with(good, Aspect::variance), with(bad, Aspect::variance)}) == 1);
  CHECK(earned({good, with(good, Aspect::variance), with(bad, Aspect::efficiency)}) == 1.5);
  CHECK(earned({good, with(bad, Aspect::variance), with(bad, Aspect::efficiency)}) == 1);
  // A wrong answer earns nothing, however fast.
  CHECK(earned({bad, with(good, Aspect::variance)}) == 0);
  CHECK(earned({good, bad, with(good, Aspect::efficiency)}) == 0);
  CHECK_THROWS_AS(earned({with(good, Aspect::variance)}), carlo::Error);
  const std::string text =
      report_text(collect(demo_lab(), {good, with(bad, Aspect::variance)}, "Lab 1.1"));
  CHECK(has(text, "right, but its variance is too large: 1 of 2 points"));
  CHECK(has(text, "✗ 1.1"));
}

TEST_CASE("a test's tags name its aspect", "[report]") {
  CHECK(aspect_of({"lab01", "ex1"}) == Aspect::correctness);
  CHECK(aspect_of({"lab01", "variance"}) == Aspect::variance);
  CHECK(aspect_of({"efficiency", "ex1"}) == Aspect::efficiency);
  CHECK_THROWS_AS(aspect_of({"efficiency", "variance"}), carlo::Error);
}

TEST_CASE("a report names the fewest mistakes that explain what was seen", "[report]") {
  const Diagnosis by_n{"by-n", "N"}, of_one{"of-one", "one"}, other{"other", "other"};
  const auto ids = [](const std::vector<Verdict>& verdicts) {
    const TestRecord record{"Lab 1.1", "it holds", verdicts, Status::failed, "", ""};
    std::string text;
    for (const Diagnosis& diagnosis : diagnoses({record}))
      text += diagnosis.id + " ";
    return text;
  };
  const auto seen = [&](double value) {
    return equals("it", value, 0, 0, {{1, by_n}, {2, of_one}, {value == 5 ? 5.0 : 1.0, other}});
  };
  // Two mistakes give 1: the one that also explains the rest is named.
  CHECK(ids({seen(1)}) == "by-n other ");
  CHECK(ids({seen(1), seen(5)}) == "other ");
  // Each explains something, and neither was looked for in vain.
  CHECK(ids({equals("it", 1, 0, 0, {{1, by_n}}), equals("it", 2, 0, 0, {{2, of_one}})}) ==
        "by-n of-one ");
  // One fits by chance, in a case of a mistake that the others rule out.
  const Suspects both{{1, of_one}, {4, other}};
  CHECK(ids({equals("it", 1, 0, 0, {{1, by_n}}), equals("it", 1, 0, 0, {{1, by_n}}),
             equals("it", 1, 0, 0, both), equals("it", 3, 0, 0, both)}) == "by-n ");
  // Looked for in vain once, it still explains the most.
  CHECK(ids({seen(2), seen(2), seen(2), seen(7)}) == "of-one ");
  CHECK(ids({seen(7)}).empty());
}

TEST_CASE("an exercise without a test and a test without an exercise are errors", "[report]") {
  const carlo::Lab lab = demo_lab();
  CHECK_THROWS_AS(collect(lab, {passed("Lab 1.1")}, ""), carlo::Error);
  CHECK_THROWS_AS(collect(lab, {}, "Lab 1.1"), carlo::Error);
  CHECK_THROWS_AS(collect(lab, {passed("Lab 1.1")}, "Lab 1.9"), carlo::Error);
  CHECK_THROWS_AS(collect(lab, {passed("Lab 1.3")}, ""), carlo::Error);
}

TEST_CASE("a test without a verdict, or of a framework that failed, does not pass", "[run]") {
  Run run(Worker(fixture_worker(), Level::limits), 1, {});
  run.begin_test("Lab 1.1: says nothing");
  run.end_test(true);
  run.begin_test("Lab 1.1: passes, but something else went wrong");
  run.record(holds("it", true, "1", "1"));
  run.end_test(false);
  run.begin_test("Lab 1.1: passes");
  run.record(holds("it", true, "1", "1"));
  run.end_test(true);
  CHECK(run.records()[0].status == Status::failed);
  CHECK(run.records()[1].status == Status::failed);
  CHECK(run.records()[2].status == Status::passed);
  CHECK_THROWS_AS(run.begin_test("no tag"), carlo::Error);
}

TEST_CASE("the budget of statistical comparisons is kept", "[run]") {
  Run run(Worker(fixture_worker(), Level::limits), 1, {});
  run.begin_test("Lab 1.1: judges without end");
  const std::vector<double> values{0};
  for (int i = 0; i < lab_budget; ++i)
    run.record(mean_is("it", values, {}));
  CHECK_THROWS_AS(run.record(mean_is("it", values, {})), carlo::Error);
  CHECK(run.trouble().find("80 statistical comparisons") != std::string::npos);
}

TEST_CASE("after a deadline or a missing implementation an exercise starts no more workers",
          "[run]") {
  Run run(Worker(fixture_worker(), Level::limits), 1, {});
  for (const char* test : {"Lab 1.1: first", "Lab 1.1: second"}) {
    run.begin_test(test);
    CHECK_THROWS_AS(run.probe("not implemented", {}, {}), ProbeFailure);
    run.end_test(false);
  }
  CHECK(run.records()[1].status == Status::not_implemented);
  CHECK(run.records()[1].skipped);
  CHECK(run.records()[1].problem ==
        "not run: your code called a function that is not implemented yet in \"first\"");
  run.begin_test("Lab 1.2: is quick", Aspect::efficiency);
  run.end_test(false);
  CHECK(run.records()[2].aspect == Aspect::efficiency);
  CHECK(run.records()[0].needs == "Lab 0.1");  // the fixture throws the tag of another exercise
}

TEST_CASE("the report names points, what failed and what it looks like", "[report]") {
  const LabResult result = collect(demo_lab(), {passed("Lab 1.1"), failed("Lab 1.2")}, "");
  const std::string text = report_text(result);
  CHECK(has(text, "✓ 1.1  First   2 of 2 points"));
  CHECK(has(text, "✗ 1.2  Second  0 of 3 points"));
  CHECK(has(text, "it: 1\n        expected 2"));
  CHECK(has(text, "one is missing."));
  CHECK(has(text, "./carlo hint 1.2"));
  CHECK(has(text, "Lab 01: 2 of 5 points"));
}

TEST_CASE("what it looks like comes before what was measured", "[report]") {
  const std::string text =
      report_text(collect(demo_lab(), {passed("Lab 1.1"), failed("Lab 1.2")}, ""));
  CHECK(text.find("Likely cause: one is missing.") < text.find("✗ it holds"));
  CHECK(text.find("✗ it holds") < text.find("expected 2"));
}

TEST_CASE("of a crash without a line it is said how to find it", "[report]") {
  TestRecord crashed{"Lab 1.2", "it holds", {}, Status::crashed, "it crashed: division", ""};
  crashed.lacks_line = true;
  const std::string advice =
      "To find the line of the crash (the first build takes minutes): CARLO_PRESET=debug ./carlo test 1.2";
  CHECK(has(report_text(collect(demo_lab(), {passed("Lab 1.1"), crashed}, "")), advice));
  crashed.problem += ", in labs/01_demo/demo.cpp:3 (n = 2)";
  crashed.lacks_line = false;
  CHECK_FALSE(has(report_text(collect(demo_lab(), {passed("Lab 1.1"), crashed}, "")), advice));
}

TEST_CASE("a crash is shown first, and how to find its line beside it", "[report]") {
  const auto with = [](const std::string& sentence, Status status, const std::string& problem) {
    TestRecord test{"Lab 1.2", sentence, {}, status, problem, ""};
    if (problem.empty()) test.verdicts = {holds("it", false, "1", "2")};
    test.lacks_line = status == Status::crashed;
    return test;
  };
  const std::string advice =
      "To find the line of the crash (the first build takes minutes): CARLO_PRESET=debug ./carlo test "
      "1.2\n";
  const LabResult result = collect(
      demo_lab(),
      {passed("Lab 1.1"), with("small", Status::failed, ""), with("large", Status::failed, ""),
       with("empty", Status::crashed, "it crashed: abort"),
       with("long", Status::crashed, "it crashed: abort")},
      "");
  const std::string text = report_text(result);
  CHECK(has(text, "    ✗ empty\n      it crashed: abort\n      " + advice + "    ✗ small\n"));
  CHECK(has(text, "    also fails: large\n    also crashes: long\n"));
  CHECK(text.find(advice) == text.rfind(advice));
  const std::string all = report_text(result, true);
  CHECK(has(all, "    ✗ empty\n      it crashed: abort\n      " + advice + "    ✗ long\n"));
  CHECK(all.find("✗ small") < all.find("✗ empty"));
  CHECK(all.find(advice) == all.rfind(advice));
}

TEST_CASE("of what a program printed a report shows the first lines", "[report]") {
  TestRecord flood{"Lab 1.2", "it holds", {}, Status::crashed, "it printed more than 1 MB", ""};
  for (int i = 1; i <= 30; ++i)
    flood.printed += fmt::format("line {}\n", i);
  flood.printed += "é" + std::string(200, 'x');
  flood.lost_lines = 1000;
  const LabResult result = collect(demo_lab(), {passed("Lab 1.1"), flood}, "");
  const std::string text = report_text(result), all = report_text(result, true);
  CHECK(has(text, "| line 3\n        | and 1028 more lines\n"));
  CHECK(has(all, "| line 20\n        | and 1011 more lines\n"));
  flood.printed = "é" + std::string(200, 'x');
  flood.lost_lines = 0;
  const std::string wide = report_text(collect(demo_lab(), {passed("Lab 1.1"), flood}, ""));
  CHECK(has(wide, "| é" + std::string(78, 'x') + "…\n    For"));
  flood.printed = "a\nb\nc\nd";
  const std::string four = report_text(collect(demo_lab(), {passed("Lab 1.1"), flood}, ""));
  CHECK(has(four, "| c\n        | and 1 more line\n"));
}

TEST_CASE("a seed is named once, and only when it is not the usual one", "[report]") {
  LabResult result = collect(demo_lab(), {failed("Lab 1.1"), failed("Lab 1.2")}, "");
  result.usual_seed = true;
  CHECK_FALSE(has(report_text(result), "--seed"));
  CHECK(has(report_text(result), "The raw values: ./carlo replay 1.2\n"));
  result.usual_seed = false;
  result.seed = 7;
  const std::string text = report_text(result);
  CHECK(has(text, "--seed 7 after ./carlo test or ./carlo replay\n"));
  CHECK(text.find("--seed") == text.rfind("--seed"));
}

TEST_CASE("of an exercise that is begun it is said what is missing and what works", "[report]") {
  carlo::Lab lab = demo_lab();
  lab.exercises[1].functions = {"Sums::add", "Sums::mean", "Sums::merge"};
  const auto open = [](const std::string& sentence, const std::string& function) {
    TestRecord test{"Lab 1.2", sentence, {}, Status::not_implemented, "not implemented yet", ""};
    test.missing = function;
    return test;
  };
  const LabResult result =
      collect(lab, {passed("Lab 1.1"), passed("Lab 1.2"), open("parts add up", "merge")}, "");
  const std::string text = report_text(result);
  CHECK(has(text, "still to write: Sums::merge\n    ✓ it holds\n    – parts add up\n"));
  CHECK(has(text, "Next: write Sums::merge; for help: ./carlo hint 1.2"));
  CHECK(has(shortfall(result.exercises[1]), "still to write: Sums::merge"));
  // A function name that is not the exercise's is not repeated.
  const LabResult forged =
      collect(lab, {passed("Lab 1.1"), passed("Lab 1.2"), open("parts add up", "everything")}, "");
  CHECK_FALSE(has(report_text(forged), "everything"));
  const LabResult untouched =
      collect(lab, {passed("Lab 1.1"), open("it holds", "add"), open("parts add up", "merge")}, "");
  CHECK(has(report_text(untouched), "not implemented yet: ./carlo hint 1.2"));
}

TEST_CASE("all tests of an exercise in parts run, whatever one found", "[run]") {
  Run run(Worker(fixture_worker(), Level::limits), 1, {});
  run.has_parts("Lab 1.1");
  for (const char* test : {"Lab 1.1: first", "Lab 1.1: second"}) {
    run.begin_test(test);
    CHECK_THROWS_AS(run.probe("not implemented", {}, {}), ProbeFailure);
    run.end_test(false);
  }
  CHECK_FALSE(run.records()[1].skipped);
  CHECK_FALSE(run.records()[1].missing.empty());
}

TEST_CASE("an exercise that calls an unfinished one names that one", "[report]") {
  TestRecord open{"Lab 1.2", "it holds", {}, Status::not_implemented, "not implemented yet", ""};
  open.needs = "Lab 1.1";
  const std::string text = report_text(collect(demo_lab(), {passed("Lab 1.1"), open}, ""));
  CHECK(has(text, "calls Lab 1.1, which is not implemented yet: ./carlo hint 1.1"));
}

TEST_CASE("an exercise that builds on a wrong one says so", "[report]") {
  carlo::Lab lab = demo_lab();
  lab.exercises[1].uses = {"Lab 1.1"};
  const std::string phrase = "Lab 1.1 is not right yet";
  CHECK(has(report_text(collect(lab, {failed("Lab 1.1"), failed("Lab 1.2")}, "")), phrase));
  CHECK_FALSE(has(report_text(collect(lab, {passed("Lab 1.1"), failed("Lab 1.2")}, "")), phrase));
  CHECK_FALSE(has(report_text(collect(lab, {failed("Lab 1.1"), passed("Lab 1.2")}, "")), phrase));
}

TEST_CASE("tests that were not run are not said to fail", "[report]") {
  const TestRecord slow{"Lab 1.1", "it ends", {}, Status::timeout, "it was not done", ""};
  TestRecord skipped = slow;
  skipped.problem = "not run: your code took too long in \"it ends\"";
  skipped.skipped = true;
  const std::string text =
      report_text(collect(demo_lab(), {slow, skipped, skipped, passed("Lab 1.2")}, ""));
  CHECK(has(text, "2 more tests not run: your code took too long in \"it ends\""));
  CHECK_FALSE(has(text, "also fails"));
}

TEST_CASE("a test that is left unjudged has not passed, and says why", "[run]") {
  Run run(Worker(fixture_worker(), Level::limits), 1, {});
  run.begin_test("Lab 1.1: it is fast", Aspect::efficiency);
  run.leave("not judged: the count is wrong");
  run.end_test(true);
  const std::vector<TestRecord> records{failed("Lab 1.1"), run.records()[0], passed("Lab 1.2")};
  const LabResult result = collect(demo_lab(), records, "");
  CHECK(result.earned() == 3);
  CHECK(result.exercises[0].status == Status::failed);
  CHECK(has(report_text(result), "    1 more test not judged: the count is wrong\n"));
  CHECK_FALSE(has(report_text(result), "it is fast"));
}

TEST_CASE("who has done nothing yet is told where to start", "[report]") {
  const auto open = [](const std::string& tag) {
    return TestRecord{tag, "it holds", {}, Status::not_implemented, "not implemented yet", ""};
  };
  const std::string start = "Nothing done yet: start with Lab 1.1, ./carlo hint 1.1";
  CHECK(has(report_text(collect(demo_lab(), {open("Lab 1.1"), open("Lab 1.2")}, "")), start));
  CHECK_FALSE(
      has(report_text(collect(demo_lab(), {failed("Lab 1.1"), open("Lab 1.2")}, "")), start));
}

TEST_CASE("a verbose report shows what passed too", "[report]") {
  const LabResult result = collect(demo_lab(), {passed("Lab 1.1"), failed("Lab 1.2")}, "");
  CHECK(has(report_text(result, true), "✓ it holds\n      it: 1\n        expected 1"));
  CHECK_FALSE(has(report_text(result), "expected 1\n"));
}

TEST_CASE("what a program printed cannot steer the terminal", "[report]") {
  TestRecord crashed{"Lab 1.1",
                     "it holds",
                     {},
                     Status::crashed,
                     "it threw \x1b[8m\nLab 01: 5 of 5 points\xC2\x9B",
                     "\x1b[2Jgotcha\r"};
  const std::string text = report_text(collect(demo_lab(), {crashed, passed("Lab 1.2")}, ""));
  CHECK(has(text, "gotcha"));
  CHECK_FALSE(has(text, "\x1b"));
  CHECK_FALSE(has(text, "\xC2\x9B"));
  CHECK_FALSE(has(text, "\nLab 01: 5 of 5 points"));
  CHECK_FALSE(has(text, "\r"));
}
