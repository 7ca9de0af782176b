#include "grader/page/grade_page.h"

#include "course/json/json_fields.h"
#include "course/report/page.h"
#include "grader/page/exercise.h"
#include "grader/page/text.h"

#include <fmt/core.h>

#include <algorithm>

namespace carlo::web {
std::string_view grade_css();
}

namespace carlo::grader {
namespace {

/// Makes text printable, valid UTF-8.
std::string cleaned(const std::string& text) {
  return valid_utf8(printable(text));
}

/// Returns the text in place of exercises that were not judged.
std::string problem_html(const LabPage& lab) {
  std::string out;
  if (!lab.note.empty()) {
    out += fmt::format("<p class=\"note\">{}</p>\n", html(cleaned(lab.note)));
  }
  if (!lab.compiler.empty()) {
    out += fmt::format("<pre>{}</pre>\n", html(cleaned(lab.compiler)));
  }
  return out;
}

std::string lab_html(const LabPage& lab) {
  const LabResult& result = lab.result;
  std::string overview, details;
  for (const ExerciseResult& exercise : result.exercises) {
    overview += overview_row(exercise, result.lab);
    details += exercise_html(exercise, result.lab);
  }
  std::string out = problem_html(lab);
  if (!overview.empty()) {
    out += "<div class=\"scroll\"><table class=\"overview\"><tbody>\n" + overview +
           "</tbody></table></div>\n";
  }
  if (!result.whole) {
    out += "<p class=\"soft\">Only a part of the lab's exercises was judged.</p>\n";
  }
  return out + details;
}

std::string in_all(const std::vector<LabPage>& labs) {
  double points = 0;
  int possible = 0;
  for (const LabPage& lab : labs) {
    points += lab.result.earned();
    possible += lab.result.possible();
  }
  return fmt::format("{} of {} points", points_text(points), possible);
}

}  // namespace

std::string grade_page(const std::vector<LabPage>& labs, const PageWords& words) {
  Page page(cleaned(words.title), words.subtitle.empty() ? in_all(labs) : cleaned(words.subtitle));
  page.style(web::grade_css());
  for (const LabPage& lab : labs) {
    const LabResult& result = lab.result;
    if (labs.size() > 1) {
      page.section(
          printable(fmt::format("Lab {:02}: {} – {} of {} points", result.lab, result.title,
                                points_text(result.earned()), result.possible())));
    }
    page.raw_html(lab_html(lab));
  }
  for (const auto& [name, value] : words.facts)
    page.fact(cleaned(name), cleaned(value));
  return page.html();
}

bool something_failed(const LabResult& lab) {
  return std::any_of(lab.exercises.begin(), lab.exercises.end(), [](const ExerciseResult& one) {
    return one.status != Status::passed && one.status != Status::not_implemented;
  });
}

}  // namespace carlo::grader
