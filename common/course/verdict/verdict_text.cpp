#include "course/verdict/verdict_text.h"

#include "course/cli/wrap.h"
#include "course/verdict/printed.h"
#include "support/terminal.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>

namespace carlo {
namespace {

/// The first few of many failures tell the story: tests shown in full, comparisons of each, and the
/// diagnoses that fit best. Likewise the first lines of what a program printed; more if everything
/// is requested.
constexpr std::size_t shown_tests = 2;
constexpr int shown_comparisons = 2;
constexpr std::size_t shown_diagnoses = 2;
constexpr std::size_t shown_lines = 3, shown_lines_verbose = 20;

std::string comparison(const Verdict& verdict) {
  std::string out = fmt::format("      {}: {}\n        expected {}\n", verdict.what,
                                verdict.measured, verdict.expected);
  if (!verdict.certainty.empty()) out += fmt::format("        {}\n", verdict.certainty);
  return out;
}

/// Describes why no values came, if so. `locate`: the exercise's number, if the text should say how
/// to find the line of a crash.
std::string problem(const TestRecord& test, std::size_t lines, const std::string& locate) {
  std::string out;
  if (!test.problem.empty()) out += fmt::format("      {}\n", harmless(test.problem));
  if (!locate.empty()) {
    out += fmt::format("      {}: {}\n", which_line, line_command(locate));
  }
  if (!test.printed.empty()) {
    out += "      your program printed:\n" + printed_lines(test, lines, "        | ");
  }
  return out;
}

/// Describes one test with all its comparisons.
std::string whole_test(const TestRecord& test, const std::string& locate) {
  const bool passed = test.status == Status::passed;
  const char* mark = passed ? "✓" : test.skipped ? "–" : "✗";
  std::string out = fmt::format("    {} {}\n", mark, test.sentence);
  out += problem(test, shown_lines_verbose, locate);
  for (const Verdict& verdict : test.verdicts)
    out += comparison(verdict);
  return out;
}

/// Describes all tests, in order.
std::string whole_tests(const ExerciseResult& result) {
  const auto lost = std::find_if(result.tests.begin(), result.tests.end(),
                                 [](const TestRecord& test) { return test.lacks_line; });
  std::string out;
  for (auto test = result.tests.begin(); test != result.tests.end(); ++test) {
    out += whole_test(*test, test == lost ? result.number() : "");
  }
  return out;
}

std::string failed_test(const TestRecord& test, const std::string& locate) {
  std::string out = fmt::format("    {} {}\n", coloured(Colour::red, "✗"), test.sentence);
  out += problem(test, shown_lines, locate);
  int failures = 0;
  for (const Verdict& verdict : test.verdicts) {
    if (!verdict.passed && ++failures <= shown_comparisons) out += comparison(verdict);
  }
  if (failures > shown_comparisons) {
    const int more = failures - shown_comparisons;
    out += fmt::format("      and {} more {}\n", more,
                       more == 1 ? "comparison that fails" : "comparisons that fail");
  }
  return out;
}

std::string heading(const ExerciseResult& result, std::size_t titles) {
  const bool passed = result.status == Status::passed || result.right_by_itself();
  const bool open = result.status == Status::not_implemented;
  const std::string mark = passed ? coloured(Colour::green, "✓")
                           : open ? coloured(Colour::yellow, "–")
                                  : coloured(Colour::red, "✗");
  const std::string title = shortened(result.title, titles);
  const std::string gap(titles - display_width(title), ' ');
  const std::string points = fmt::format("{} of {} points", points_text(result.points), result.max);
  return fmt::format("{} {}  {}{}  {}", mark, result.number(), title, gap, points);
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Says how to get an exercise's hint.
std::string hint_by(Help help, const std::string& number) {
  return help == Help::by_key ? "press h" : "./carlo hint " + number;
}

/// Says why an exercise is not implemented: it is not done, or another one that it calls is not.
std::string open_text(const ExerciseResult& result, Help help) {
  for (const TestRecord& test : result.tests) {
    if (test.needs.rfind("Lab ", 0) != 0) continue;
    const std::string needs = harmless(test.needs);
    return fmt::format("calls {}, which is not implemented yet: ./carlo hint {}", needs,
                       needs.substr(4));
  }
  return "not implemented yet: " + hint_by(help, result.number());
}

bool failed(const TestRecord& test) {
  return test.status != Status::passed && test.status != Status::not_implemented && !test.skipped;
}

/// Returns the failed tests, most informative first: one that crashed, since numbers do not show
/// the cause; then those with numbers; then the other crashes, which mostly repeat the first.
std::vector<const TestRecord*> by_what_they_tell(const ExerciseResult& result) {
  std::vector<const TestRecord*> list;
  for (const TestRecord& test : result.tests) {
    if (failed(test)) list.push_back(&test);
  }
  const auto crashed = [](const TestRecord* test) { return test->status == Status::crashed; };
  std::stable_partition(list.begin(), list.end(), [&](const auto* test) { return !crashed(test); });
  auto first = std::find_if(list.begin(), list.end(),
                            [](const TestRecord* test) { return test->lacks_line; });
  if (first == list.end()) first = std::find_if(list.begin(), list.end(), crashed);
  if (first != list.end()) std::rotate(list.begin(), first, std::next(first));
  return list;
}

/// Says how many tests were not run, or not judged, for each reason.
std::string skipped_tests(const ExerciseResult& result) {
  std::map<std::string, int> reasons;
  for (const TestRecord& test : result.tests) {
    if (test.skipped) ++reasons[test.problem];
  }
  std::string out;
  for (const auto& [why, count] : reasons) {
    out += fmt::format("    {} more {} {}\n", count, count == 1 ? "test" : "tests", harmless(why));
  }
  return out;
}

/// Describes the failed tests, the first ones in full, and those not run after a deadline. Omits
/// those that wait for unwritten code.
std::string failed_tests(const ExerciseResult& result) {
  std::string out;
  const std::vector<const TestRecord*> tests = by_what_they_tell(result);
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const TestRecord& test = *tests[i];
    const bool locate = i == 0 && test.lacks_line;
    out += i < shown_tests ? failed_test(test, locate ? result.number() : "")
                           : fmt::format("    also {}: {}\n", test.lacks_line ? "crashes" : "fails",
                                         test.sentence);
  }
  return out + skipped_tests(result);
}

/// Names exercises that this one builds on and that are not right yet.
std::string unsound_ground(const ExerciseResult& result) {
  std::string out;
  if (result.by_itself) return fmt::format("    {}\n", by_itself_text(result));
  for (const std::string& tag : result.unsound) {
    out += fmt::format("    {} is not right yet, and your code calls it: fix that first\n", tag);
  }
  return out;
}

/// Lists the tests that fail with the suite's version of what the exercise builds on. The values of
/// the first judgement would show the other's mistakes, too.
std::string failed_by_itself(const ByItself& judgement) {
  std::string out;
  for (const std::string& sentence : judgement.failures)
    out += fmt::format("    {} {}\n", coloured(Colour::red, "✗"), sentence);
  return out;
}

/// Says why right values do not earn all the points.
std::string right_but(const ExerciseResult& result) {
  if (result.by_itself || !result.passed(Aspect::correctness)) return "";
  // A test that crashed or was stopped has measured neither variance nor cost.
  const auto unmeasured = [](const TestRecord& test) {
    return test.status == Status::crashed || test.status == Status::timeout;
  };
  if (std::any_of(result.tests.begin(), result.tests.end(), unmeasured)) return "";
  const bool variance = result.has(Aspect::variance) && !result.passed(Aspect::variance);
  const bool cost = result.has(Aspect::efficiency) && !result.passed(Aspect::efficiency);
  return fmt::format("    right, but {}{}{}: {} of {} points\n",
                     variance ? "its variance is too large" : "", variance && cost ? " and " : "",
                     cost ? "it costs too much" : "", points_text(result.points), result.max);
}

/// Describes likely causes, first of all: they say most in the fewest lines.
std::string likely_causes(const ExerciseResult& result) {
  std::string out;
  const std::vector<Diagnosis>& causes = result.causes();
  for (std::size_t i = 0; i < std::min(causes.size(), shown_diagnoses); ++i) {
    out += fmt::format("    {} {}\n", coloured(Colour::bold, "Likely cause:"), causes[i].sentence);
  }
  return out;
}

/// For a partly written exercise: what is missing, what already works, what to do next. `tests`:
/// with the tests.
std::string begun_text(const ExerciseResult& result, bool tests, Help help) {
  std::string passed, waiting;
  for (const TestRecord& test : result.tests) {
    if (test.skipped) continue;
    if (test.status == Status::passed) passed += fmt::format("    ✓ {}\n", test.sentence);
    if (test.status == Status::not_implemented) waiting += fmt::format("    – {}\n", test.sentence);
  }
  const std::vector<std::string>& missing = result.missing;
  std::string out = missing.empty() ? "    " + open_text(result, help) + "\n"
                                    : fmt::format("    still to write: {}\n", joined(missing));
  out += unsound_ground(result) + likely_causes(result);
  if (tests) out += passed + waiting + failed_tests(result);
  const std::string hint = hint_by(help, result.number());
  return out + (missing.empty()
                    ? fmt::format("    Next: {}\n", hint)
                    : fmt::format("    Next: write {}; for help: {}\n", missing.front(), hint));
}

/// Says what keeps an exercise from all its points; `tests`: with the failed tests.
std::string details(const ExerciseResult& result, bool tests, Help help) {
  std::string out = right_but(result) + unsound_ground(result) + likely_causes(result);
  if (tests) out += result.by_itself ? failed_by_itself(*result.by_itself) : failed_tests(result);
  return out + fmt::format("    For help: {}\n", hint_by(help, result.number()));
}

std::string exercise_text(const ExerciseResult& result, std::size_t titles, bool verbose) {
  std::string out = heading(result, titles);
  if (result.right_by_itself())
    return out + "\n" + unsound_ground(result) + (verbose ? whole_tests(result) : "");
  const bool open = result.status == Status::not_implemented;
  if (open && !result.begun) return fmt::format("{}  {}\n", out, open_text(result, Help::typed));
  out += "\n";
  if (result.status != Status::passed) {
    out +=
        open ? begun_text(result, !verbose, Help::typed) : details(result, !verbose, Help::typed);
  }
  if (verbose) out += whole_tests(result);
  if (result.status == Status::passed || result.by_itself) return out;
  return out + fmt::format("    The raw values: ./carlo replay {}\n", result.number());
}

/// Says what to do next, below the total.
std::string advice(const LabResult& result) {
  if (result.earned() == result.possible()) return "";
  const bool untouched = std::all_of(
      result.exercises.begin(), result.exercises.end(), [](const ExerciseResult& entry) {
        return entry.status == Status::not_implemented && !entry.begun;
      });
  if (untouched) {
    const ExerciseResult& first = result.exercises.front();
    return fmt::format("Nothing done yet: start with {}, ./carlo hint {}\n", first.tag,
                       first.number());
  }
  // Without --seed, seeds are the same each time.
  if (result.usual_seed) return "";
  return fmt::format(
      "To repeat with the same numbers: --seed {} after ./carlo test or ./carlo replay\n",
      result.seed);
}

}  // namespace

std::string shortfall(const ExerciseResult& result, Help help) {
  if (result.status == Status::passed) return "";
  if (result.right_by_itself()) return unsound_ground(result);
  if (result.begun) return begun_text(result, true, help);
  if (result.status == Status::not_implemented) return "    " + open_text(result, help) + "\n";
  return details(result, true, help);
}

std::string by_itself_text(const ExerciseResult& result) {
  const std::string others = joined(result.by_itself->replaced);
  const bool several = result.by_itself->replaced.size() > 1;
  if (result.right_by_itself()) {
    return fmt::format("{} is right by itself; {}, which it calls, {} not", result.number(), others,
                       several ? "are" : "is");
  }
  return fmt::format(
      "{} {} not right yet; with the suite's in place of yours, this is not {}either", others,
      several ? "are" : "is", result.by_itself->points > 0 ? "all right " : "right ");
}

std::string message(const ExerciseResult& result) {
  for (const TestRecord& test : result.tests) {
    if (test.status == Status::passed) continue;
    if (!test.problem.empty()) return test.sentence + ": " + test.problem;
    for (const Verdict& verdict : test.verdicts) {
      if (verdict.passed) continue;
      return fmt::format("{}: {}: {}; expected {}", test.sentence, verdict.what, verdict.measured,
                         verdict.expected);
    }
  }
  return "";
}

std::string report_text(const LabResult& result, bool verbose) {
  std::size_t titles = 0;
  for (const ExerciseResult& entry : result.exercises) {
    titles = std::max(titles, display_width(entry.title));
  }
  constexpr std::size_t mark_number_points = 25;
  titles = std::min(titles, room_beside(mark_number_points, 16));
  std::string out =
      fmt::format("Lab {:02}  {}\n(sandbox: {})\n", result.lab, result.title, result.sandbox);
  for (const ExerciseResult& entry : result.exercises)
    out += exercise_text(entry, titles, verbose);
  const bool full = result.earned() == result.possible();
  const std::string total = fmt::format("Lab {:02}{}: {} of {} points", result.lab,
                                        result.whole ? "" : ", this exercise alone",
                                        points_text(result.earned()), result.possible());
  out += coloured(full ? Colour::green : Colour::bold, total) + "\n";
  return out + advice(result);
}

}  // namespace carlo
