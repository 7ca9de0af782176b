#include "grader/page/exercise.h"

#include "course/verdict/verdict_text.h"
#include "grader/page/figure_svg.h"
#include "grader/page/text.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <vector>

namespace carlo::grader {

namespace {

/// The first few of many failures tell the story: comparisons of a test in full, those that fit in
/// a line, and diagnoses.
constexpr std::size_t shown_comparisons = 4;
constexpr std::size_t shown_brief = 6;
constexpr std::size_t shown_diagnoses = 2;

std::string anchor(const ExerciseResult& exercise, int lab) {
  std::string id = fmt::format("lab-{}-{}", lab, exercise.number());
  for (char& c : id) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z');
    if (!plain) c = '-';
  }
  return id;
}

struct Look {
  const char* style;
  const char* sign;
  const char* words;
};

Look look_of(Status status) {
  switch (status) {
    case Status::passed:
      return {"passed", "✓", "passed"};
    case Status::failed:
      return {"failed", "✗", "failed"};
    case Status::crashed:
      return {"failed", "✗", "crashed"};
    case Status::timeout:
      return {"failed", "✗", "too slow"};
    case Status::not_implemented:
      return {"open", "–", "not done"};
    case Status::not_submitted:
      return {"open", "–", "not submitted"};
    case Status::refused:
      return {"failed", "✗", "refused"};
    case Status::does_not_compile:
      return {"failed", "✗", "does not compile"};
    case Status::grader_error:
      return {"open", "–", "not graded"};
  }
  return {"failed", "✗", "failed"};
}

/// Returns whether the values are right and only their variance or cost is not.
bool right_but(const ExerciseResult& exercise) {
  if (exercise.by_itself) return exercise.points > 0;
  return exercise.status != Status::passed && exercise.passed(Aspect::correctness);
}

Look look_of(const ExerciseResult& exercise) {
  if (exercise.right_by_itself()) return {"passed", "✓", "right by itself"};
  if (right_but(exercise)) return {"failed", "◐", "in part"};
  return look_of(exercise.by_itself ? exercise.by_itself->status : exercise.status);
}

std::string chip(const ExerciseResult& exercise) {
  const Look look = look_of(exercise);
  return fmt::format("<span class=\"chip {}\">{}<span class=\"words\"> {}</span></span>",
                     look.style, look.sign, look.words);
}

std::string points(const ExerciseResult& exercise) {
  const bool none = exercise.status == Status::grader_error;
  return fmt::format("{} of {} points", none ? "?" : points_text(exercise.points), exercise.max);
}

/// Returns correctness, variance, efficiency: those that this exercise is judged by, if more than
/// one, and if it was judged without others' mistakes.
std::string aspects(const ExerciseResult& exercise) {
  if (exercise.by_itself) return "";
  if (!exercise.has(Aspect::variance) && !exercise.has(Aspect::efficiency)) return "";
  if (exercise.status == Status::not_implemented) return "";
  std::string out;
  for (const Aspect aspect : {Aspect::correctness, Aspect::variance, Aspect::efficiency}) {
    if (!exercise.has(aspect)) continue;
    const bool passed = exercise.passed(aspect);
    out += fmt::format("<span class=\"chip {}\">{} {}</span>", passed ? "passed" : "failed",
                       passed ? "✓" : "✗", to_string(aspect));
  }
  return "<span class=\"aspects\">" + out + "</span>";
}

/// For an open exercise: returns the one to do first.
std::string needs_of(const ExerciseResult& exercise) {
  for (const TestRecord& test : exercise.tests) {
    if (test.needs.starts_with("Lab ")) return test.needs;
  }
  return "";
}

std::string hint(const std::string& number) {
  return fmt::format("<code>./carlo hint {}</code>", html(number));
}

// One comparison -------------------------------------------------------------------------------

/// Returns whether it fits in a line: an exact comparison without a figure.
bool is_brief(const Verdict& verdict) {
  return verdict.certainty.empty() && !verdict.figure;
}

std::string verdict_html(const Verdict& verdict) {
  std::string words = fmt::format("<dt>measured</dt><dd>{}</dd><dt>expected</dt><dd>{}</dd>",
                                  html(verdict.measured), html(verdict.expected));
  if (!verdict.certainty.empty()) {
    words += fmt::format("<dt>how sure</dt><dd>{}</dd>", html(verdict.certainty));
  }
  return fmt::format(
      "<div class=\"verdict\"><div><p class=\"what\">{}</p><dl>{}</dl></div>{}</div>\n",
      html(verdict.what), words, verdict.figure ? figure_html(*verdict.figure) : "");
}

/// Returns brief comparisons, one line each.
std::string verdict_rows(const std::vector<const Verdict*>& verdicts) {
  std::string out =
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Table\"><table>"
      "<thead><tr><th></th><th>what</th><th>measured</th><th>expected</th></tr></thead>\n<tbody>\n";
  for (const Verdict* verdict : verdicts) {
    out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                       verdict->passed ? "✓" : "✗", html(verdict->what), html(verdict->measured),
                       html(verdict->expected));
  }
  return out + "</tbody></table></div>\n";
}

std::string folded_verdicts(const std::string& summary,
                            const std::vector<const Verdict*>& verdicts) {
  if (verdicts.empty()) return "";
  return fmt::format("<details><summary>{}</summary>{}</details>\n", summary,
                     verdict_rows(verdicts));
}

// One test -------------------------------------------------------------------------------------

std::string failed_test(const TestRecord& test, const std::string& number) {
  std::string out = fmt::format("<div class=\"test\">\n<h4>✗ {}</h4>\n", html(test.sentence));
  if (!test.problem.empty()) {
    out += fmt::format("<p class=\"problem\">{}</p>\n", html(test.problem));
  }
  if (test.lacks_line) {
    out += fmt::format("<p class=\"help\">{}: <code>{}</code></p>\n", which_line,
                       html(line_command(number)));
  }
  if (!test.printed.empty()) {
    out += fmt::format("<p class=\"soft\">Your program printed:</p>\n<pre>{}</pre>\n",
                       html(test.printed));
  }
  std::vector<const Verdict*> brief, more, passed;
  std::string full;
  std::size_t shown = 0;
  for (const Verdict& verdict : test.verdicts) {
    if (verdict.passed) {
      passed.push_back(&verdict);
    } else if (is_brief(verdict)) {
      (brief.size() < shown_brief ? brief : more).push_back(&verdict);
    } else if (++shown <= shown_comparisons) {
      full += verdict_html(verdict);
    } else {
      more.push_back(&verdict);
    }
  }
  if (shown > 0) {
    out += fmt::format("<div class=\"verdicts{}\">\n{}</div>\n", shown == 1 ? " one" : "", full);
  }
  if (!brief.empty()) out += verdict_rows(brief);
  out += folded_verdicts(
      fmt::format("And {} more {}", more.size(),
                  more.size() == 1 ? "comparison that fails" : "comparisons that fail"),
      more);
  out += folded_verdicts(fmt::format("What passed in this test: {}", passed.size()), passed);
  return out + "</div>\n";
}

/// Returns the failed tests in order, except that a crashed one comes first.
std::vector<const TestRecord*> failed_tests(const ExerciseResult& exercise) {
  std::vector<const TestRecord*> list;
  for (const TestRecord& test : exercise.tests) {
    if (test.status != Status::passed && !test.skipped) list.push_back(&test);
  }
  const auto crashed = std::find_if(list.begin(), list.end(),
                                    [](const TestRecord* test) { return test->lacks_line; });
  if (crashed != list.end()) std::rotate(list.begin(), crashed, std::next(crashed));
  return list;
}

std::string passed_tests(const ExerciseResult& exercise) {
  std::string out;
  for (const TestRecord& test : exercise.tests) {
    if (test.status != Status::passed) continue;
    std::vector<const Verdict*> verdicts;
    for (const Verdict& verdict : test.verdicts)
      verdicts.push_back(&verdict);
    out += fmt::format("<h4>✓ {}</h4>\n{}", html(test.sentence),
                       verdicts.empty() ? "" : verdict_rows(verdicts));
  }
  return out;
}

std::string skipped_tests(const ExerciseResult& exercise) {
  std::map<std::string, int> reasons;
  for (const TestRecord& test : exercise.tests) {
    if (test.skipped) ++reasons[test.problem];
  }
  std::string out;
  for (const auto& [why, count] : reasons) {
    out += fmt::format("<p class=\"soft\">{} more {} {}</p>\n", count,
                       count == 1 ? "test" : "tests", html(why));
  }
  return out;
}

// One exercise ---------------------------------------------------------------------------------

std::string diagnosis(const ExerciseResult& exercise) {
  std::string out;
  const std::vector<Diagnosis>& causes = exercise.causes();
  for (std::size_t i = 0; i < std::min(causes.size(), shown_diagnoses); ++i)
    out += fmt::format("<p>{}</p>\n", html(causes[i].sentence));
  if (out.empty()) return "";
  return "<div class=\"diagnosis\"><p><strong>Likely cause:</strong></p>\n" + out + "</div>\n";
}

std::string unsound_ground(const ExerciseResult& exercise) {
  std::string out;
  if (exercise.by_itself) return "<p class=\"note\">" + html(by_itself_text(exercise)) + "</p>\n";
  for (const std::string& tag : exercise.unsound) {
    out += fmt::format(
        "<p class=\"note\">{} is not right yet, and your code calls it: fix that first.</p>\n",
        html(tag));
  }
  return out;
}

/// Returns the tests, failed ones in full.
std::string all_tests(const ExerciseResult& exercise) {
  std::string out;
  for (const TestRecord* test : failed_tests(exercise))
    out += failed_test(*test, exercise.number());
  out += skipped_tests(exercise);
  const std::string passed = passed_tests(exercise);
  if (passed.empty()) return out;
  return out + "<details class=\"passed-tests\"><summary>The tests that passed</summary>\n" +
         passed + "</details>\n";
}

/// Returns which tests fail in the second judgement. What was measured in the first one shows the
/// mistakes of other exercises, too, and is folded.
std::string by_itself_tests(const ExerciseResult& exercise) {
  if (exercise.right_by_itself()) return "";
  std::string out;
  for (const std::string& sentence : exercise.by_itself->failures)
    out += fmt::format("<div class=\"test\">\n<h4>✗ {}</h4>\n</div>\n", html(sentence));
  return out + fmt::format(
                   "<details class=\"passed-tests\"><summary>What was measured with your own {}, "
                   "whose mistakes show here, too</summary>\n{}</details>\n",
                   html(fmt::format("{}", fmt::join(exercise.by_itself->replaced, ", "))),
                   all_tests(exercise));
}

/// Returns whether there is more to say than in the overview; an unfinished exercise has more if
/// begun.
bool has_details(const ExerciseResult& exercise) {
  const std::vector<TestRecord>& tests = exercise.tests;
  if (exercise.status != Status::not_implemented) return !tests.empty();
  return std::any_of(tests.begin(), tests.end(), [](const TestRecord& test) {
    return !test.skipped && test.status != Status::not_implemented;
  });
}

std::string heading(const ExerciseResult& exercise) {
  return fmt::format("{}<h3>{} {}</h3><span class=\"points\">{}</span>{}", chip(exercise),
                     html(exercise.number()), html(exercise.title), points(exercise),
                     aspects(exercise));
}

}  // namespace

std::string overview_row(const ExerciseResult& exercise, int lab) {
  const std::string number = exercise.number();
  std::string words = html(exercise.title);
  if (has_details(exercise)) {
    words = fmt::format("<a href=\"#{}\">{} {}</a>", anchor(exercise, lab), html(number), words);
  } else if (exercise.status != Status::not_implemented) {
    words = fmt::format("{} {}", html(number), words);
  } else {
    const std::string needs = needs_of(exercise);
    const std::string first = needs.empty() || needs == exercise.tag
                                  ? hint(number)
                                  : fmt::format("calls {}: {}", html(needs), hint(needs.substr(4)));
    words = fmt::format("{} {} <span class=\"soft\">{}</span>", html(number), words, first);
  }
  return fmt::format("<tr><td>{}</td><td>{}{}</td><td class=\"number\">{}</td></tr>\n",
                     chip(exercise), words, aspects(exercise), points(exercise));
}

std::string exercise_html(const ExerciseResult& exercise, int lab) {
  if (!has_details(exercise)) return "";
  const std::string id = anchor(exercise, lab);
  if (exercise.status == Status::passed) {
    return fmt::format(
        "<details class=\"exercise passed\" id=\"{}\"><summary>{}</summary>\n{}</details>\n", id,
        heading(exercise), passed_tests(exercise));
  }
  const bool right = exercise.right_by_itself();
  std::string out = fmt::format("<article class=\"exercise{}\" id=\"{}\">\n<header>{}</header>\n",
                                right ? " passed" : "", id, heading(exercise));
  out += diagnosis(exercise) + unsound_ground(exercise);
  if (!right) out += fmt::format("<p class=\"help\">For help: {}</p>\n", hint(exercise.number()));
  out += exercise.by_itself ? by_itself_tests(exercise) : all_tests(exercise);
  return out + "</article>\n";
}

}  // namespace carlo::grader
