#include "grader/grade/outputs.h"

#include "course/verdict/printed.h"
#include "grader/grade/handed_in.h"
#include "grader/page/grade_page.h"
#include "support/atomic_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <sstream>

namespace carlo::grader {
namespace {

std::string cell(const std::optional<double>& points) {
  return points ? points_text(*points) : "";
}

std::string of_points(const std::optional<double>& points, int max) {
  return fmt::format("{} of {} points", points ? points_text(*points) : "not graded:", max);
}

/// Puts a margin before each line of a text.
std::string quoted(const std::string& text) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    out += fmt::format("  | {}\n", harmless(line));
  return out;
}

std::string lab_report(const LabGrade& lab) {
  std::string out;
  if (!lab.unjudged) {
    out = lab.report;
    if (!lab.note.empty()) out += quoted(lab.note);
  } else {
    out = fmt::format("Lab {:02}  {}\n", lab.result.lab, lab.result.title) + quoted(lab.note) +
          fmt::format("Lab {:02}: {}\n", lab.result.lab, of_points(lab.points(), lab.max()));
  }
  if (!lab.compiler.empty()) out += "The compiler says:\n" + quoted(lab.compiler);
  return out + "\n";
}

void sort_by_name(std::vector<Record>& records) {
  std::sort(records.begin(), records.end(),
            [](const Record& a, const Record& b) { return a.name < b.name; });
}

std::string heading(const Record& record) {
  std::string line = "name";
  for (const LabGrade& lab : record.labs) {
    for (const ExerciseResult& exercise : lab.result.exercises)
      line += fmt::format(",{}", exercise.number());
    line += fmt::format(",lab {}", lab.result.lab);
  }
  return line + ",total,max,status,source\n";
}

/// Formats a stranger's name as a cell: quoted, with a start that prevents a formula.
std::string source_cell(const std::string& source) {
  std::string text = "\"./";
  const std::string shown = clipped(harmless(source), 300);
  const bool keep_letters = is_harmless_utf8(shown);
  for (const char c : shown) {
    if (c == '"') text += c;
    const bool letter = static_cast<unsigned char>(c) < 0x80 || keep_letters;
    text += c == '\n' || c == '\r' ? ' ' : letter ? c : '?';
  }
  return text + "\"";
}

}  // namespace

std::string report_text(const Record& record) {
  std::string out = record.name + "\n\n";
  for (const LabGrade& lab : record.labs)
    out += lab_report(lab);
  if (record.labs.size() > 1) out += "In all: " + of_points(record.points(), record.max()) + "\n";
  if (record.ignored.empty()) return out;
  out += "\nNot looked at, because they are no exercise files or cannot be taken:\n";
  for (const std::string& file : record.ignored)
    out += quoted(file);
  return out;
}

std::string class_csv(std::vector<Record> records) {
  sort_by_name(records);
  std::string out = records.empty() ? "" : heading(records.front());
  for (const Record& record : records) {
    out += record.name;
    for (const LabGrade& lab : record.labs) {
      for (const ExerciseResult& exercise : lab.result.exercises)
        out += fmt::format(",{}", cell(points_of(exercise)));
      out += fmt::format(",{}", cell(lab.points()));
    }
    out += fmt::format(",{},{},{},{}\n", cell(record.points()), record.max(), record.status(),
                       source_cell(record.source));
  }
  return out;
}

std::string timing_csv(std::vector<Record> records) {
  sort_by_name(records);
  std::string out = "name,lab,compile seconds,judge seconds,compile peak MB,judge peak MB\n";
  for (const Record& record : records) {
    for (const LabGrade& lab : record.labs) {
      out += fmt::format("{},{},{:.2f},{:.2f},{},{}\n", record.name, lab.result.lab,
                         lab.compile_seconds, lab.judge_seconds, lab.compile_peak_bytes >> 20,
                         lab.judge_peak_bytes >> 20);
    }
  }
  return out;
}

void write_outputs(const Record& record, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  write_file(folder / "results.json", gradescope_json(record));
  write_file(folder / "junit.xml", junit_xml(record));
  write_file(folder / "report.txt", report_text(record));
  std::vector<LabPage> labs;
  for (const LabGrade& lab : record.labs)
    labs.push_back({lab.result, lab.note, lab.compiler});
  write_file(folder / "report.html", grade_page(labs, {.title = record.name}));
  write_file(folder / "record.json", to_json(record));
}

}  // namespace carlo::grader
