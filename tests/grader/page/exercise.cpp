#include "grader/page/exercise.h"

#include "cli/error.h"
#include "grader/judge/crash_line.h"
#include "grader/judge/figure_json.h"
#include "grader/page/figure_svg.h"
#include "grader/page/text.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <vector>

namespace carlo::grader {

using nlohmann::json;

namespace {

/// Of many failures the first few tell the story: comparisons of a test in full, those that fit in
/// a line, and diagnoses.
constexpr std::size_t shown_comparisons = 4;
constexpr std::size_t shown_brief = 6;
constexpr std::size_t shown_diagnoses = 2;

/// "7.3" of "Lab 7.3".
std::string number_of(const json& exercise) {
  const std::string tag = text_in(exercise, "tag");
  return tag.rfind("Lab ", 0) == 0 ? tag.substr(4) : tag;
}

std::string anchor(const json& exercise, const std::string& lab) {
  std::string id = fmt::format("lab-{}-{}", lab, number_of(exercise));
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

Look look_of(const std::string& status) {
  if (status == "passed") return {"passed", "✓", "passed"};
  if (status == "not_implemented") return {"open", "–", "not done"};
  if (status == "not_submitted") return {"open", "–", "not submitted"};
  if (status == "grader_error") return {"open", "–", "not graded"};
  if (status == "refused") return {"failed", "✗", "refused"};
  if (status == "does_not_compile") return {"failed", "✗", "does not compile"};
  if (status == "crashed") return {"failed", "✗", "crashed"};
  if (status == "timeout") return {"failed", "✗", "too slow"};
  return {"failed", "✗", "failed"};
}

/// Whether the values are right and only their variance or their cost is not.
bool right_but(const json& exercise) {
  const auto aspects = exercise.find("aspects");
  return text_in(exercise, "status") != "passed" && aspects != exercise.end() &&
         true_in(*aspects, "correctness");
}

std::string chip(const json& exercise) {
  const Look look =
      right_but(exercise) ? Look{"failed", "◐", "in part"} : look_of(text_in(exercise, "status"));
  return fmt::format("<span class=\"chip {}\">{}<span class=\"words\"> {}</span></span>",
                     look.style, look.sign, look.words);
}

std::string points(const json& exercise) {
  return fmt::format("{} of {} points", number_in(exercise, "points"), number_in(exercise, "max"));
}

/// Correctness, variance, efficiency: those that this exercise is judged by, if more than one.
std::string aspects(const json& exercise) {
  const auto found = exercise.find("aspects");
  if (found == exercise.end() || !found->is_object() || found->size() < 2) return "";
  if (text_in(exercise, "status") == "not_implemented") return "";
  std::string out;
  for (const char* name : {"correctness", "variance", "efficiency"}) {
    const auto aspect = found->find(name);
    if (aspect == found->end() || !aspect->is_boolean()) continue;
    const bool passed = aspect->get<bool>();
    out += fmt::format("<span class=\"chip {}\">{} {}</span>", passed ? "passed" : "failed",
                       passed ? "✓" : "✗", name);
  }
  return out.empty() ? "" : "<span class=\"aspects\">" + out + "</span>";
}

/// Of an open exercise: the one to do first.
std::string needs_of(const json& exercise) {
  for (const json& test : list_in(exercise, "tests")) {
    std::string needs = text_in(test, "needs");
    if (needs.rfind("Lab ", 0) == 0) return needs;
  }
  return "";
}

std::string hint(const std::string& number) {
  return fmt::format("<code>./carlo hint {}</code>", html(number));
}

// One comparison -------------------------------------------------------------------------------

std::string figure_of(const json& verdict) {
  const auto found = verdict.find("figure");
  if (found == verdict.end() || found->is_null()) return "";
  try {
    return figure_html(figure_from_json(*found));
  } catch (const Error&) {
    return "<p class=\"soft\">The figure of this comparison cannot be read.</p>\n";
  }
}

/// An exact comparison without a figure says all in one line.
bool is_brief(const json& verdict) {
  const auto figure = verdict.find("figure");
  return text_in(verdict, "certainty").empty() && (figure == verdict.end() || figure->is_null());
}

std::string verdict_html(const json& verdict) {
  std::string words =
      fmt::format("<dt>measured</dt><dd>{}</dd><dt>expected</dt><dd>{}</dd>",
                  html(text_in(verdict, "measured")), html(text_in(verdict, "expected")));
  const std::string certainty = text_in(verdict, "certainty");
  if (!certainty.empty()) words += fmt::format("<dt>how sure</dt><dd>{}</dd>", html(certainty));
  return fmt::format(
      "<div class=\"verdict\"><div><p class=\"what\">{}</p><dl>{}</dl></div>{}</div>\n",
      html(text_in(verdict, "what")), words, figure_of(verdict));
}

/// Comparisons in short: one line each.
std::string verdict_rows(const std::vector<const json*>& verdicts) {
  std::string out =
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Table\"><table>"
      "<thead><tr><th></th><th>what</th><th>measured</th><th>expected</th></tr></thead>\n<tbody>\n";
  for (const json* verdict : verdicts) {
    out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                       true_in(*verdict, "passed") ? "✓" : "✗", html(text_in(*verdict, "what")),
                       html(text_in(*verdict, "measured")), html(text_in(*verdict, "expected")));
  }
  return out + "</tbody></table></div>\n";
}

std::string folded_verdicts(const std::string& summary, const std::vector<const json*>& verdicts) {
  if (verdicts.empty()) return "";
  return fmt::format("<details><summary>{}</summary>{}</details>\n", summary,
                     verdict_rows(verdicts));
}

// One test -------------------------------------------------------------------------------------

std::string failed_test(const json& test, const std::string& number) {
  std::string out =
      fmt::format("<div class=\"test\">\n<h4>✗ {}</h4>\n", html(text_in(test, "sentence")));
  const std::string problem = text_in(test, "problem"), printed = text_in(test, "printed");
  if (!problem.empty()) out += fmt::format("<p class=\"problem\">{}</p>\n", html(problem));
  if (lacks_line(problem)) {
    out += fmt::format("<p class=\"help\">{}: <code>{}</code></p>\n", which_line,
                       html(line_command(number)));
  }
  if (!printed.empty()) {
    out +=
        fmt::format("<p class=\"soft\">Your program printed:</p>\n<pre>{}</pre>\n", html(printed));
  }
  std::vector<const json*> brief, more, passed;
  std::string full;
  std::size_t shown = 0;
  for (const json& verdict : list_in(test, "verdicts")) {
    if (true_in(verdict, "passed")) {
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

/// The tests that failed, in their order, but first of all one that crashed.
std::vector<const json*> failed_tests(const json& exercise) {
  std::vector<const json*> list;
  for (const json& test : list_in(exercise, "tests")) {
    if (text_in(test, "status") != "passed" && !true_in(test, "skipped")) list.push_back(&test);
  }
  const auto crashed = std::find_if(list.begin(), list.end(), [](const json* test) {
    return lacks_line(text_in(*test, "problem"));
  });
  if (crashed != list.end()) std::rotate(list.begin(), crashed, std::next(crashed));
  return list;
}

std::string passed_tests(const json& exercise) {
  std::string out;
  for (const json& test : list_in(exercise, "tests")) {
    if (text_in(test, "status") != "passed") continue;
    std::vector<const json*> verdicts;
    for (const json& verdict : list_in(test, "verdicts"))
      verdicts.push_back(&verdict);
    out += fmt::format("<h4>✓ {}</h4>\n{}", html(text_in(test, "sentence")),
                       verdicts.empty() ? "" : verdict_rows(verdicts));
  }
  return out;
}

std::string skipped_tests(const json& exercise) {
  std::map<std::string, int> reasons;
  for (const json& test : list_in(exercise, "tests")) {
    if (true_in(test, "skipped")) ++reasons[text_in(test, "problem")];
  }
  std::string out;
  for (const auto& [why, count] : reasons) {
    out += fmt::format("<p class=\"soft\">{} more {} {}</p>\n", count,
                       count == 1 ? "test" : "tests", html(why));
  }
  return out;
}

// One exercise ---------------------------------------------------------------------------------

/// The sentence of a diagnosis, wherever a comparison gives it.
std::string sentence_of(const json& exercise, const json& id) {
  for (const json& test : list_in(exercise, "tests")) {
    for (const json& verdict : list_in(test, "verdicts")) {
      for (const json& diagnosis : list_in(verdict, "diagnoses")) {
        if (diagnosis.is_object() && diagnosis.value("id", json()) == id) {
          return text_in(diagnosis, "sentence");
        }
      }
    }
  }
  return "";
}

std::string diagnosis(const json& exercise) {
  std::string out;
  std::size_t shown = 0;
  for (const json& id : list_in(exercise, "diagnoses")) {
    const std::string sentence = sentence_of(exercise, id);
    if (sentence.empty() || shown++ == shown_diagnoses) continue;
    out += fmt::format("<p>{}</p>\n", html(sentence));
  }
  if (out.empty()) return "";
  return "<div class=\"diagnosis\"><p><strong>It looks like this:</strong></p>\n" + out +
         "</div>\n";
}

std::string unsound_ground(const json& exercise) {
  std::string out;
  for (const json& tag : list_in(exercise, "unsound")) {
    if (!tag.is_string()) continue;
    out += fmt::format(
        "<p class=\"note\">{} is not right yet: where your code calls it, mend that first.</p>\n",
        html(tag.get<std::string>()));
  }
  return out;
}

/// Whether there is more to say than the overview does: of one that is not done, if it is begun.
bool has_details(const json& exercise) {
  const json& tests = list_in(exercise, "tests");
  if (text_in(exercise, "status") != "not_implemented") return !tests.empty();
  return std::any_of(tests.begin(), tests.end(), [](const json& test) {
    return !true_in(test, "skipped") && text_in(test, "status") != "not_implemented";
  });
}

std::string heading(const json& exercise) {
  return fmt::format("{}<h3>{} {}</h3><span class=\"points\">{}</span>{}", chip(exercise),
                     html(number_of(exercise)), html(text_in(exercise, "title")), points(exercise),
                     aspects(exercise));
}

}  // namespace

std::string overview_row(const json& exercise, const std::string& lab) {
  const std::string status = text_in(exercise, "status"), number = number_of(exercise);
  std::string words = html(text_in(exercise, "title"));
  if (has_details(exercise)) {
    words = fmt::format("<a href=\"#{}\">{} {}</a>", anchor(exercise, lab), html(number), words);
  } else if (status != "not_implemented") {
    words = fmt::format("{} {}", html(number), words);
  } else {
    const std::string needs = needs_of(exercise);
    const std::string first = needs.empty() || needs == text_in(exercise, "tag")
                                  ? hint(number)
                                  : fmt::format("calls {}: {}", html(needs), hint(needs.substr(4)));
    words = fmt::format("{} {} <span class=\"soft\">{}</span>", html(number), words, first);
  }
  return fmt::format("<tr><td>{}</td><td>{}{}</td><td class=\"number\">{}</td></tr>\n",
                     chip(exercise), words, aspects(exercise), points(exercise));
}

std::string exercise_html(const json& exercise, const std::string& lab) {
  const std::string status = text_in(exercise, "status");
  if (!has_details(exercise)) return "";
  const std::string id = anchor(exercise, lab);
  if (status == "passed") {
    return fmt::format(
        "<details class=\"exercise passed\" id=\"{}\"><summary>{}</summary>\n{}</details>\n", id,
        heading(exercise), passed_tests(exercise));
  }
  std::string out = fmt::format("<article class=\"exercise\" id=\"{}\">\n<header>{}</header>\n", id,
                                heading(exercise));
  out += diagnosis(exercise) + unsound_ground(exercise);
  out += fmt::format("<p class=\"help\">For help: {}</p>\n", hint(number_of(exercise)));
  for (const json* test : failed_tests(exercise))
    out += failed_test(*test, number_of(exercise));
  out += skipped_tests(exercise);
  const std::string passed = passed_tests(exercise);
  if (!passed.empty()) {
    out += "<details class=\"passed-tests\"><summary>The tests that passed</summary>\n" + passed +
           "</details>\n";
  }
  return out + "</article>\n";
}

}  // namespace carlo::grader
