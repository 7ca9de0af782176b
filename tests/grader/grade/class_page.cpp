#include "grader/grade/class_page.h"

#include "course/verdict/printed.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

namespace carlo::grader {
namespace {

/// How one student did in one exercise.
enum class Standing { right, by_itself, partly, wrong, follows, not_done, not_judged };

Standing standing_of(const ExerciseResult& exercise) {
  if (exercise.status == Status::grader_error) return Standing::not_judged;
  if (exercise.right_by_itself()) return Standing::by_itself;
  if (exercise.points >= exercise.max) return Standing::right;
  if (exercise.status >= Status::not_implemented) return Standing::not_done;
  if (!exercise.unsound.empty() && !exercise.by_itself) return Standing::follows;
  return exercise.points > 0 ? Standing::partly : Standing::wrong;
}

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
      return {"itself", "all points: right by itself, but an exercise that it builds on is not"};
    case Standing::partly:
      return {"partly", "some points"};
    case Standing::wrong:
      return {"wrong", "no points"};
    case Standing::follows:
      return {"follows", "not right, but neither is one that it builds on: not judged by itself"};
    case Standing::not_done:
      return {"undone", "not done, not handed in, or not compiled"};
    case Standing::not_judged:
      return {"unjudged", "no marks: an error of the grader"};
  }
  return {"unjudged", ""};
}

/// One exercise over the whole class.
struct Column {
  const ExerciseResult* exercise = nullptr;  ///< of some record: its tag and title
  std::map<Standing, std::size_t> standings;
  double points = 0;
  /// By id: the sentence, and for how many students it is the likeliest mistake.
  std::map<std::string, std::pair<std::string, std::size_t>> mistakes;

  std::size_t count(Standing standing) const {
    const auto found = standings.find(standing);
    return found == standings.end() ? 0 : found->second;
  }
  /// Students who have marks in it.
  std::size_t judged() const {
    std::size_t sum = 0;
    for (const auto& [standing, number] : standings)
      sum += standing == Standing::not_judged ? 0 : number;
    return sum;
  }
  double share(std::size_t students) const {
    return judged() == 0 ? 0 : static_cast<double>(students) / static_cast<double>(judged());
  }
};

std::vector<Column> columns_of(const std::vector<Record>& records) {
  std::vector<Column> columns;
  for (const LabGrade& lab : records.front().labs) {
    for (const ExerciseResult& exercise : lab.result.exercises)
      columns.push_back({&exercise, {}, 0, {}});
  }
  for (const Record& record : records) {
    std::size_t at = 0;
    for (const LabGrade& lab : record.labs) {
      for (const ExerciseResult& exercise : lab.result.exercises) {
        Column& column = columns.at(at++);
        const Standing standing = standing_of(exercise);
        ++column.standings[standing];
        if (standing != Standing::not_judged) column.points += exercise.points;
        const bool right = standing == Standing::right || standing == Standing::by_itself;
        if (right || exercise.diagnoses.empty()) continue;
        const Diagnosis& likeliest = exercise.diagnoses.front();
        auto& [sentence, number] = column.mistakes[likeliest.id];
        sentence = likeliest.sentence;
        ++number;
      }
    }
  }
  return columns;
}

/// Best first; equal marks by name.
void rank(std::vector<Record>& records) {
  std::sort(records.begin(), records.end(), [](const Record& a, const Record& b) {
    const double x = a.points().value_or(-1), y = b.points().value_or(-1);
    return x != y ? x > y : a.name < b.name;
  });
}

Table exercises_table(const std::vector<Column>& columns) {
  Table table({"exercise", "title", "right", "right by itself", "some points", "no points",
               "follow-on", "not done", "mean points", "of"});
  for (const Column& column : columns) {
    const auto number = [&](Standing standing) { return static_cast<int>(column.count(standing)); };
    const auto judged = static_cast<double>(column.judged());
    table.add_row({column.exercise->number(), column.exercise->title,
                   percent_cell(column.share(column.count(Standing::right)), 2),
                   percent_cell(column.share(column.count(Standing::by_itself)), 2),
                   number(Standing::partly), number(Standing::wrong), number(Standing::follows),
                   number(Standing::not_done),
                   number_cell(judged > 0 ? column.points / judged : 0, 2), column.exercise->max});
  }
  return table;
}

/// The most frequent first, over all exercises.
Table mistakes_table(const std::vector<Column>& columns) {
  struct Row {
    std::string exercise, sentence;
    std::size_t students;
  };
  std::vector<Row> rows;
  for (const Column& column : columns) {
    for (const auto& [id, mistake] : column.mistakes)
      rows.push_back({column.exercise->number(), mistake.first, mistake.second});
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return a.students > b.students; });
  Table table({"students", "exercise", "mistake"});
  for (const Row& row : rows)
    table.add_row({static_cast<int>(row.students), row.exercise, row.sentence});
  return table;
}

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

std::string student_row(const Record& record, const std::string& name) {
  std::string html = fmt::format("<tr><th scope=\"row\">{}</th>", html_escaped(name));
  for (const LabGrade& lab : record.labs) {
    for (const ExerciseResult& exercise : lab.result.exercises) {
      const Look look = look_of(standing_of(exercise));
      const auto points = points_of(exercise);
      const bool undone = standing_of(exercise) == Standing::not_done;
      html += fmt::format("<td class=\"{}\" title=\"{}: {}\">{}</td>", look.style,
                          html_escaped(exercise.number()), look.words,
                          !points  ? "?"
                          : undone ? "–"
                                   : points_text(*points));
    }
  }
  const auto all = record.points();
  return html + fmt::format("<td>{}</td></tr>\n", all ? points_text(*all) : "?");
}

std::string legend() {
  std::string html = "<p class=\"class-legend\">";
  for (const Standing standing :
       {Standing::right, Standing::by_itself, Standing::partly, Standing::wrong, Standing::follows,
        Standing::not_done, Standing::not_judged}) {
    const Look look = look_of(standing);
    html += fmt::format("<span><i class=\"{}\"></i> {}</span> ", look.style, look.words);
  }
  return html + "</p>\n";
}

std::string matrix(const std::vector<Record>& records, bool names) {
  std::string html =
      legend() +
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Students and "
      "exercises\"><table class=\"class-matrix\">\n" +
      header_row(records) + "<tbody>\n";
  const std::map<std::string, std::string> shown = shown_names(records, names);
  for (const Record& record : records)
    html += student_row(record, shown.at(record.name));
  return html + "</tbody></table></div>\n";
}

// Colours differ in lightness, too, and each cell has its points, so that print without colour and
// readers who see none lose nothing.
constexpr const char* class_style = R"(
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
.unjudged { outline: 2px dashed var(--series-2); outline-offset: -2px; }
.class-legend span { display: inline-block; margin-right: 1rem; }
.class-legend i { display: inline-block; width: 1.1em; height: 1.1em; vertical-align: -.2em;
  border: 1px solid var(--rule); }
@media print {
  .class-matrix, .class-legend i { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  .class-matrix thead { display: table-header-group; }
  .class-matrix tr { break-inside: avoid; }
  .class-matrix { font-size: 7pt; }
}
)";

constexpr const char* mistakes_note =
    "The likeliest mistake of each exercise that is not right, where the judge can name one.";
constexpr const char* follow_on_note =
    "Right by itself: judged with the suite's version of an exercise that it builds on and that is "
    "not right. Follow-on: not right, neither is such an exercise, and the suite's version could "
    "not take its place.";

}  // namespace

std::map<std::string, std::string> shown_names(std::vector<Record> records, bool names) {
  rank(records);
  std::map<std::string, std::string> shown;
  for (const Record& record : records)
    shown[record.name] = names ? record.name : fmt::format("student {}", shown.size() + 1);
  return shown;
}

Page class_page(std::vector<Record> records, bool names) {
  rank(records);
  const std::vector<Column> columns = columns_of(records);
  const auto graded = static_cast<std::size_t>(
      std::count_if(records.begin(), records.end(), [](const Record& r) { return r.complete(); }));
  Page page("The class", fmt::format("{} submissions, {} of them graded; at most {} points",
                                     records.size(), graded, records.front().max()));
  page.style(class_style);
  page.section("Exercises");
  page.table(exercises_table(columns));
  page.prose(follow_on_note);
  const Table mistakes = mistakes_table(columns);
  if (!mistakes.rows().empty()) {
    page.section("Mistakes");
    page.prose(mistakes_note);
    page.table(mistakes);
  }
  page.section("Students");
  page.raw_html(matrix(records, names));
  page.fact("command", "./carlo grade");
  return page;
}

}  // namespace carlo::grader
