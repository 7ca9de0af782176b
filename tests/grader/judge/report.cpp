#include "grader/judge/report.h"

#include "cli/terminal.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

namespace carlo::grader {
namespace {

/// Of many failures the first few tell the story: tests shown in full, comparisons of each, and the
/// diagnoses that fit best.
constexpr int shown_tests = 2;
constexpr int shown_comparisons = 2;
constexpr std::size_t shown_diagnoses = 2;

/// How far the columns reach, in characters (bytes of UTF-8 that start one).
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string indent(const std::string& text, const std::string& margin) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    out += margin + harmless(line) + "\n";
  return out;
}

std::string comparison(const Verdict& verdict) {
  std::string out = fmt::format("      {}: {}\n        expected {}\n", verdict.what,
                                verdict.measured, verdict.expected);
  if (!verdict.certainty.empty()) out += fmt::format("        {}\n", verdict.certainty);
  return out;
}

/// One test with all that it compared.
std::string whole_test(const TestRecord& test) {
  const bool passed = test.status == Status::passed;
  std::string out = fmt::format("    {} {}\n", passed ? "✓" : "✗", test.sentence);
  if (!test.problem.empty()) out += fmt::format("      {}\n", harmless(test.problem));
  for (const Verdict& verdict : test.verdicts)
    out += comparison(verdict);
  return out;
}

std::string failed_test(const TestRecord& test) {
  std::string out = fmt::format("    {} {}\n", coloured(Colour::red, "✗"), test.sentence);
  if (!test.problem.empty()) out += fmt::format("      {}\n", harmless(test.problem));
  if (!test.printed.empty()) {
    out += "      your program printed:\n" + indent(test.printed, "        | ");
  }
  int failures = 0;
  for (const Verdict& verdict : test.verdicts) {
    if (!verdict.passed && ++failures <= shown_comparisons) out += comparison(verdict);
  }
  if (failures > shown_comparisons) {
    out += fmt::format("      and {} more like these\n", failures - shown_comparisons);
  }
  return out;
}

std::string heading(const ExerciseResult& result, std::size_t titles) {
  const bool passed = result.status == Status::passed;
  const bool open = result.status == Status::not_implemented;
  const std::string mark = passed ? coloured(Colour::green, "✓")
                           : open ? coloured(Colour::yellow, "–")
                                  : coloured(Colour::red, "✗");
  const std::string& title = result.exercise.title;
  const std::string gap(titles - width(title), ' ');
  const std::string points =
      fmt::format("{} of {} points", points_text(result.earned()), result.exercise.points);
  return fmt::format("{} {}  {}{}  {}", mark, result.exercise.number(), title, gap, points);
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Why an exercise is not implemented: it is not done, or another is not that its code calls.
std::string open_text(const ExerciseResult& result) {
  for (const TestRecord& test : result.tests) {
    if (test.needs.rfind("Lab ", 0) != 0) continue;
    const std::string needs = harmless(test.needs);
    return fmt::format("calls {}, which is not implemented yet: ./carlo hint {}", needs,
                       needs.substr(4));
  }
  return fmt::format("not implemented yet: ./carlo hint {}", result.exercise.number());
}

/// The tests that failed, the first ones in full; and those that were not run after a deadline. Not
/// those that wait for something to be written.
std::string failed_tests(const ExerciseResult& result) {
  std::string out;
  int failures = 0, skipped = 0;
  std::string why;
  for (const TestRecord& test : result.tests) {
    const bool waits = test.status == Status::not_implemented && !test.skipped;
    if (test.status == Status::passed || waits) continue;
    if (test.skipped) {
      ++skipped;
      why = harmless(test.problem);
      continue;
    }
    out += ++failures <= shown_tests ? failed_test(test)
                                     : fmt::format("    also fails: {}\n", test.sentence);
  }
  if (skipped > 0) {
    out += fmt::format("    {} more {} {}\n", skipped, skipped == 1 ? "test" : "tests", why);
  }
  return out;
}

/// Exercises that this one builds on and that are not right yet.
std::string unsound_ground(const ExerciseResult& result, const LabResult& lab) {
  std::string out;
  for (const ExerciseResult& other : lab.exercises) {
    const std::vector<std::string>& uses = result.exercise.uses;
    const bool used = std::find(uses.begin(), uses.end(), other.exercise.tag) != uses.end();
    if (!used || other.status == Status::passed) continue;
    out += fmt::format("    {} is not right yet: where your code calls it, mend that first\n",
                       other.exercise.tag);
  }
  return out;
}

/// What keeps right values from all the points.
std::string right_but(const ExerciseResult& result) {
  if (!result.passed(Aspect::correctness)) return "";
  const bool variance = result.has(Aspect::variance) && !result.passed(Aspect::variance);
  const bool cost = result.has(Aspect::efficiency) && !result.passed(Aspect::efficiency);
  return fmt::format("    right, but {}{}{}: {} of {} points\n",
                     variance ? "its variance is too large" : "", variance && cost ? " and " : "",
                     cost ? "it costs too much" : "", points_text(result.earned()),
                     result.exercise.points);
}

/// What the values look like, first of all: it says most in the fewest lines.
std::string likely_causes(const ExerciseResult& result) {
  std::string out;
  std::vector<Diagnosis> likely = diagnoses(result);
  if (likely.size() > shown_diagnoses) likely.resize(shown_diagnoses);
  for (const Diagnosis& diagnosis : likely) {
    out += fmt::format("    {} {}\n", coloured(Colour::bold, "It looks like this:"),
                       diagnosis.sentence);
  }
  return out;
}

/// How to find out in which line a program crashed, where no report has named it.
std::string line_of_crash(const ExerciseResult& result) {
  const auto unknown = [](const TestRecord& test) {
    return test.problem.rfind("it crashed: ", 0) == 0 &&
           test.problem.find(", in labs/") == std::string::npos;
  };
  if (std::none_of(result.tests.begin(), result.tests.end(), unknown)) return "";
  return fmt::format("    In which line it crashes: CARLO_PRESET=debug ./carlo test {}\n",
                     result.exercise.number());
}

/// Of an exercise of which some is written: what is missing, what already works, what to do next.
std::string begun_text(const ExerciseResult& result, const LabResult& lab, bool tests) {
  std::string passed, waiting;
  for (const TestRecord& test : result.tests) {
    if (test.skipped) continue;
    if (test.status == Status::passed) passed += fmt::format("    ✓ {}\n", test.sentence);
    if (test.status == Status::not_implemented) waiting += fmt::format("    – {}\n", test.sentence);
  }
  const std::vector<std::string> missing = missing_functions(result);
  std::string out = missing.empty() ? "    " + open_text(result) + "\n"
                                    : fmt::format("    still to write: {}\n", joined(missing));
  out += unsound_ground(result, lab) + likely_causes(result);
  if (tests) out += passed + waiting + failed_tests(result);
  out += line_of_crash(result);
  const std::string number = result.exercise.number();
  return out + (missing.empty() ? fmt::format("    Next: ./carlo hint {}\n", number)
                                : fmt::format("    Next: write {}; for help: ./carlo hint {}\n",
                                              missing.front(), number));
}

/// What keeps an exercise from all its points; `tests`: with the tests that failed.
std::string details(const ExerciseResult& result, const LabResult& lab, bool tests) {
  std::string out = right_but(result) + unsound_ground(result, lab) + likely_causes(result);
  if (tests) out += failed_tests(result);
  return out + line_of_crash(result) +
         fmt::format("    For help: ./carlo hint {}\n", result.exercise.number());
}

std::string exercise_text(const ExerciseResult& result, const LabResult& lab, std::size_t titles,
                          bool verbose) {
  std::string out = heading(result, titles);
  const bool open = result.status == Status::not_implemented;
  if (open && !begun(result)) return fmt::format("{}  {}\n", out, open_text(result));
  out += "\n";
  if (result.status != Status::passed) {
    out += open ? begun_text(result, lab, !verbose) : details(result, lab, !verbose);
  }
  if (verbose) {
    for (const TestRecord& test : result.tests)
      out += whole_test(test);
  }
  if (result.status == Status::passed) return out;
  return out + fmt::format("    The raw values: ./carlo replay {} --seed {}\n",
                           result.exercise.number(), lab.seed);
}

/// What to do next, below the total.
std::string advice(const LabResult& result) {
  if (result.earned() == result.possible()) return "";
  const bool untouched = std::all_of(
      result.exercises.begin(), result.exercises.end(), [](const ExerciseResult& entry) {
        return entry.status == Status::not_implemented && !begun(entry);
      });
  if (untouched) {
    const Exercise& first = result.exercises.front().exercise;
    return fmt::format("Nothing done yet: start with {}, ./carlo hint {}\n", first.tag,
                       first.number());
  }
  return fmt::format("The same numbers again: --seed {}\n", result.seed);
}

}  // namespace

std::string harmless(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    if (c < 32 || c == 127) text[i] = ' ';
    if (c == 0xC2 && next >= 0x80 && next < 0xA0) text[i] = text[i + 1] = ' ';
  }
  return text;
}

std::string shortfall(const ExerciseResult& result, const LabResult& lab) {
  if (result.status == Status::passed) return "";
  if (begun(result)) return begun_text(result, lab, true);
  if (result.status == Status::not_implemented) return "    " + open_text(result) + "\n";
  return details(result, lab, true);
}

std::string report_text(const LabResult& result, bool verbose) {
  std::size_t titles = 0;
  for (const ExerciseResult& entry : result.exercises) {
    titles = std::max(titles, width(entry.exercise.title));
  }
  std::string out = fmt::format("Lab {:02}  {}  (sandbox: {})\n", result.lab.number,
                                result.lab.title, result.sandbox);
  for (const ExerciseResult& entry : result.exercises)
    out += exercise_text(entry, result, titles, verbose);
  const bool full = result.earned() == result.possible();
  const bool all = result.exercises.size() == result.lab.exercises.size();
  const std::string total = fmt::format("Lab {:02}{}: {} of {} points", result.lab.number,
                                        all ? "" : ", this exercise alone",
                                        points_text(result.earned()), result.possible());
  out += coloured(full ? Colour::green : Colour::bold, total) + "\n";
  return out + advice(result);
}

}  // namespace carlo::grader
