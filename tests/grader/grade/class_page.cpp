#include "grader/grade/class_page.h"

#include "course/verdict/printed.h"
#include "grader/grade/class_counts.h"
#include "grader/grade/sha256.h"
#include "grader/judge/numbers.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

namespace carlo::grader {
namespace {

using Shown = std::map<std::string, std::string>;

constexpr std::array all_standings{Standing::right,        Standing::by_itself, Standing::partly,
                                   Standing::wrong,        Standing::follows,   Standing::not_done,
                                   Standing::not_compiled, Standing::not_judged};

/// The class of a cell in the style sheet, and what it means.
struct Look {
  const char* style;
  const char* words;
};
Look look_of(Standing standing) {
  switch (standing) {
    case Standing::right:
      return {"right", "all points"};
    case Standing::by_itself:
      return {"itself",
              "right by itself: all points, though an exercise that it calls is not right"};
    case Standing::partly:
      return {"partly", "some points"};
    case Standing::wrong:
      return {"wrong", "no points"};
    case Standing::follows:
      return {"follows", "no points, perhaps because an exercise that it calls is not right"};
    case Standing::not_done:
      return {"undone", "not done, or not handed in"};
    case Standing::not_compiled:
      return {"uncompiled", "does not compile"};
    case Standing::not_judged:
      return {"unjudged", "no marks: an error of the grader"};
  }
  return {"unjudged", ""};
}

/// Best first; equal marks by what the page calls the students.
void rank(std::vector<Record>& records, const Shown& shown) {
  std::sort(records.begin(), records.end(), [&](const Record& a, const Record& b) {
    const double x = a.points().value_or(-1), y = b.points().value_or(-1);
    return x != y ? x > y : shown.at(a.name) < shown.at(b.name);
  });
}

// Exercises ------------------------------------------------------------------------------------

bool occurs(const std::vector<ClassColumn>& columns, Standing standing) {
  return std::any_of(columns.begin(), columns.end(),
                     [&](const ClassColumn& column) { return column.count(standing) > 0; });
}

/// Returns the meaning of the colours, of those that occur.
std::string legend(const std::vector<ClassColumn>& columns) {
  std::string html = "<p class=\"class-legend\">";
  for (const Standing standing : all_standings) {
    if (!occurs(columns, standing)) continue;
    const Look look = look_of(standing);
    html += fmt::format("<span><i class=\"{}\"></i> {}</span> ", look.style, look.words);
  }
  return html + "</p>\n";
}

/// Returns the whole class as a bar, whose parts hold the numbers of students.
std::string bar(const ClassColumn& column) {
  std::string html = "<div class=\"class-bar\">";
  for (const Standing standing : all_standings) {
    const std::size_t students = column.count(standing);
    if (students == 0) continue;
    const Look look = look_of(standing);
    html += fmt::format("<span class=\"{}\" style=\"flex-grow:{}\" title=\"{}: {}\">{}</span>",
                        look.style, students, counted(static_cast<double>(students), "student"),
                        look.words, students);
  }
  return html + "</div>";
}

std::string exercises_table(const std::vector<ClassColumn>& columns) {
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Exercises\"><table "
      "class=\"class-exercises\">\n<thead><tr><th scope=\"col\">exercise</th><th "
      "scope=\"col\">students</th><th scope=\"col\" class=\"number\">right</th><th scope=\"col\" "
      "class=\"number\">mean points</th></tr></thead>\n<tbody>\n";
  for (const ClassColumn& column : columns) {
    html += fmt::format(
        "<tr><th scope=\"row\">{} {}</th><td>{}</td><td class=\"number\">{} %</td><td "
        "class=\"number\">{} of {}</td></tr>\n",
        html_escaped(column.exercise->number()), html_escaped(column.exercise->title), bar(column),
        number_cell(100 * column.right(), 2).text, number_cell(column.mean(), 2).text,
        column.exercise->max);
  }
  return html + "</tbody></table></div>\n";
}

void add_exercises(Page& page, const std::vector<ClassColumn>& columns) {
  page.section("Exercises");
  page.prose(
      "A bar is the whole class, and the numbers in it are students. \"Right\" is the share of "
      "students who have all points of the exercise.");
  page.raw_html(legend(columns) + exercises_table(columns));
  if (occurs(columns, Standing::by_itself)) {
    page.prose(
        "A mistake costs points once: an exercise that calls one that is not right was judged again "
        "with the suite's version of that one, and has all points if it is right by itself.");
  }
}

// Mistakes -------------------------------------------------------------------------------------

/// The most frequent first, over all exercises.
Table mistakes_table(const std::vector<Record>& records, const std::vector<ClassColumn>& columns) {
  struct Row {
    std::string where;
    Mistake mistake;
  };
  std::vector<Row> rows;
  for (std::size_t lab = 0; lab < records.front().labs.size(); ++lab) {
    const std::size_t students = count_unjudged(records, lab, Status::does_not_compile);
    if (students > 0) {
      rows.push_back({fmt::format("lab {}", records.front().labs[lab].result.lab),
                      {"the code does not compile.", students}});
    }
  }
  for (const ClassColumn& column : columns) {
    for (const auto& [id, mistake] : column.mistakes)
      rows.push_back({column.exercise->number(), mistake});
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return a.mistake.students > b.mistake.students;
  });
  Table table({"students", "exercise", "mistake"});
  for (const Row& row : rows)
    table.add_row({static_cast<int>(row.mistake.students), row.where, row.mistake.sentence});
  return table;
}

// Students -------------------------------------------------------------------------------------

std::string header_row(const std::vector<Record>& records) {
  std::string html = "<thead><tr><th scope=\"col\">student</th>";
  for (const LabGrade& lab : records.front().labs) {
    for (const ExerciseResult& exercise : lab.result.exercises) {
      html += fmt::format("<th scope=\"col\" title=\"{}\">{}</th>", html_escaped(exercise.title),
                          html_escaped(exercise.number()));
    }
  }
  return html + "<th scope=\"col\">all</th></tr></thead>\n";
}

/// Returns one cell for a lab that was not judged, which says why.
std::string unjudged_cell(const LabGrade& lab) {
  const Standing standing = standing_of(lab.result.exercises.front());
  return fmt::format("<td class=\"{}\" colspan=\"{}\">{}</td>", look_of(standing).style,
                     lab.result.exercises.size(), in_words(*lab.unjudged));
}

/// Returns what stands in the cell of a judged exercise: its points, and why a program brought none
/// to its end.
std::string cell_text(const ExerciseResult& exercise, Standing standing) {
  const auto points = points_of(exercise);
  if (!points) return "?";
  if (standing == Standing::not_done) return "–";
  std::string text = points_text(*points);
  if (standing == Standing::right || standing == Standing::by_itself) return text;
  if (exercise.status == Status::crashed) text += "<small> crash</small>";
  if (exercise.status == Status::timeout) text += "<small> time</small>";
  return text;
}

std::string student_row(const Record& record, const std::string& name) {
  std::string html = fmt::format("<tr><th scope=\"row\">{}</th>", html_escaped(name));
  for (const LabGrade& lab : record.labs) {
    if (lab.unjudged) {
      html += unjudged_cell(lab);
      continue;
    }
    for (const ExerciseResult& exercise : lab.result.exercises) {
      const Standing standing = standing_of(exercise);
      const Look look = look_of(standing);
      html +=
          fmt::format("<td class=\"{}\" title=\"{}: {}\">{}</td>", look.style,
                      html_escaped(exercise.number()), look.words, cell_text(exercise, standing));
    }
  }
  const auto all = record.points();
  return html + fmt::format("<td>{}</td></tr>\n", all ? points_text(*all) : "?");
}

std::string matrix(const std::vector<Record>& records, const Shown& shown) {
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Students and "
      "exercises\"><table class=\"class-matrix\">\n" +
      header_row(records) + "<tbody>\n";
  for (const Record& record : records)
    html += student_row(record, shown.at(record.name));
  return html + "</tbody></table></div>\n";
}

// Page -----------------------------------------------------------------------------------------

// Colours differ in lightness, too, and each cell has its points, so that print without colour and
// readers who see none lose nothing.
constexpr const char* class_style = R"(
.class-exercises { width: 100%; }
.class-exercises th[scope=row] { color: var(--ink); font-weight: 400; }
.class-exercises td:nth-child(2) { width: 45%; }
.class-bar { display: flex; min-width: 7rem; border: 1px solid var(--rule); }
.class-bar span { flex-basis: 0; min-width: 1.2em; text-align: center; }
.class-bar .itself, .class-bar .follows, td.itself, td.follows {
  text-shadow: 0 0 3px var(--paper), 0 0 3px var(--paper), 0 0 3px var(--paper); }
.class-matrix th, .class-matrix td { padding: .15rem .4rem; text-align: center; }
.class-matrix th[scope=row] { position: sticky; left: 0; z-index: 1; max-width: 14rem;
  overflow: hidden; text-overflow: ellipsis; white-space: nowrap; text-align: left;
  font-weight: 400; background: var(--paper); }
.right { background: color-mix(in srgb, var(--series-3) 45%, var(--paper)); }
.itself { background: repeating-linear-gradient(45deg, var(--paper) 0 4px,
  color-mix(in srgb, var(--series-3) 45%, var(--paper)) 4px 8px); }
.partly { background: color-mix(in srgb, var(--series-5) 35%, var(--paper)); }
.wrong { background: color-mix(in srgb, var(--series-2) 55%, var(--paper)); }
.follows { background: repeating-linear-gradient(45deg, var(--paper) 0 4px,
  color-mix(in srgb, var(--series-2) 30%, var(--paper)) 4px 8px); }
.undone { color: var(--soft); }
.class-matrix small { display: block; font-size: .7em; line-height: 1; }
.uncompiled { background: color-mix(in srgb, var(--series-7) 40%, var(--paper)); }
.unjudged { outline: 2px dashed var(--series-2); outline-offset: -2px; }
.class-legend span { display: inline-block; margin-right: 1rem; }
.class-legend i { display: inline-block; width: 1.1em; height: 1.1em; vertical-align: -.2em;
  border: 1px solid var(--rule); }
@media (max-width: 34rem) {
  .class-exercises th, .class-exercises td { padding-right: .4rem; }
  .class-exercises .number { padding-left: 0; }
  .class-exercises td:nth-child(2) { width: auto; }
  .class-bar { min-width: 5.5rem; }
  .class-matrix th, .class-matrix td { padding: .15rem .25rem; font-size: .78rem; }
  .class-matrix th[scope=row] { max-width: 6rem; }
}
@media print {
  .class-matrix, .class-bar, .class-legend i { print-color-adjust: exact;
    -webkit-print-color-adjust: exact; }
  .class-matrix thead { display: table-header-group; }
  .class-matrix tr { break-inside: avoid; }
  .class-matrix { font-size: 7pt; }
}
)";

/// "lab 1", "labs 1, 2, 3"
std::string labs_in_words(const std::vector<LabGrade>& labs) {
  std::string numbers;
  for (const LabGrade& lab : labs)
    numbers += fmt::format("{}{}", numbers.empty() ? " " : ", ", lab.result.lab);
  return (labs.size() == 1 ? "lab" : "labs") + numbers;
}

std::string subtitle_of(const std::vector<Record>& records) {
  std::size_t graded = 0, broken = 0;
  for (const Record& record : records) {
    graded += record.complete() ? 1 : 0;
    broken +=
        std::any_of(record.labs.begin(), record.labs.end(),
                    [](const LabGrade& lab) { return lab.unjudged == Status::does_not_compile; })
            ? 1
            : 0;
  }
  std::string text = fmt::format("{}, {} of them graded; at most {} points",
                                 counted(static_cast<double>(records.size()), "submission"), graded,
                                 records.front().max());
  if (broken > 0) text += fmt::format("; {} {} not compile", broken, broken == 1 ? "does" : "do");
  return text;
}

}  // namespace

std::map<std::string, std::string> shown_names(const std::vector<Record>& records,
                                               const ClassWords& words) {
  std::map<std::string, std::string> by_digest, shown;
  for (const Record& record : records) {
    Sha256 digest;
    digest.add_text(words.secret);
    digest.add_text(record.name);
    by_digest[digest.hex()] = record.name;
  }
  std::size_t number = 0;
  for (const auto& [digest, name] : by_digest)
    shown[name] = words.names ? name : fmt::format("student {}", ++number);
  return shown;
}

Page class_page(std::vector<Record> records, const ClassWords& words) {
  const Shown shown = shown_names(records, words);
  rank(records, shown);
  const std::vector<ClassColumn> columns = class_columns(records);
  const std::vector<LabGrade>& labs = records.front().labs;
  Page page("The class in " + labs_in_words(labs), subtitle_of(records));
  page.style(class_style);
  add_exercises(page, columns);
  const Table mistakes = mistakes_table(records, columns);
  if (!mistakes.rows().empty()) {
    page.section("Mistakes");
    page.prose(
        "For each student and exercise that is not right, the likeliest mistake, if the judge can "
        "name one; and how many crashed, took too long or do not compile. Below, \"crash\" and "
        "\"time\" mark whose; mistakes are named in the students' reports.");
    page.table(mistakes);
  }
  page.section("Students");
  page.raw_html(legend(columns) + matrix(records, shown));
  for (const LabGrade& lab : labs)
    page.fact(fmt::format("lab {}", lab.result.lab), lab.result.title);
  page.fact("command", words.command);
  return page;
}

}  // namespace carlo::grader
