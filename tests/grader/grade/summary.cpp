#include "grader/grade/summary.h"

#include "course/verdict/printed.h"
#include "grader/grade/outputs.h"
#include "grader/judge/numbers.h"
#include "support/atomic_file.h"
#include "support/error.h"
#include "support/progress.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

/// Returns the largest and the mean cost of a lab over all judged submissions.
std::string costs(const std::vector<Record>& records, const CourseLab& lab) {
  double worst = 0, sum = 0;
  std::size_t peak = 0;
  int count = 0;
  for (const Record& record : records) {
    for (const LabGrade& grade : record.labs) {
      if (grade.result.lab != lab.lab.number || grade.unjudged) continue;
      const double seconds = grade.compile_seconds + grade.judge_seconds;
      worst = std::max(worst, seconds);
      sum += seconds;
      peak = std::max({peak, grade.compile_peak_bytes, grade.judge_peak_bytes});
      ++count;
    }
  }
  if (count == 0) return "";
  return fmt::format("  lab {:02}: {} judged, {} each, {} at most, {} MB at most\n", lab.lab.number,
                     count, format_seconds(sum / count), format_seconds(worst), peak >> 20);
}

/// Reports renamed submissions: the grader must not guess who is who. Returns how many.
std::size_t tell_renamed(const std::vector<Source>& sources) {
  std::size_t count = 0;
  for (const Source& source : sources) {
    if (!source.renamed) continue;
    fmt::print(stderr, "carlo: {} is graded as {}: another submission has its name\n",
               harmless(source.handed_in()), source.name);
    ++count;
  }
  return count;
}

/// Reports files beside the submissions: they may be some. Returns how many.
std::size_t tell_left_out(const std::vector<std::string>& files) {
  constexpr std::size_t shown = 20;
  for (std::size_t i = 0; i < std::min(files.size(), shown); ++i) {
    fmt::print(stderr, "carlo: {} is no folder, .zip, .tar, .tar.gz or .tgz: not graded\n",
               harmless(files[i]));
  }
  if (files.size() > shown) fmt::print(stderr, "carlo: and {} others\n", files.size() - shown);
  return files.size();
}

auto unfinished(const std::vector<Record>& records) {
  return std::count_if(records.begin(), records.end(),
                       [](const Record& record) { return !record.complete(); });
}

}  // namespace

std::string line_of(const Finished& finished) {
  const Record& record = finished.record;
  const std::string points = record.complete() ? points_text(*record.points()) : "no marks,";
  const std::string status = record.status() == "graded" ? "" : "  " + record.status();
  const std::string time = finished.again ? "as before" : format_seconds(finished.seconds);
  return fmt::format("{}: {} of {} points ({}){}\n", record.name, points, record.max(), time,
                     status);
}

void write_class(const std::vector<CourseLab>& labs, const std::vector<Record>& records,
                 const fs::path& out, const ClassWords& words) {
  write_file(out / "class.csv", class_csv(records));
  write_file(out / "timing.csv", timing_csv(records));
  const bool page = records.size() > 1;
  if (page) class_page(records, words).write(out / "class.html");
  const auto missing = unfinished(records);
  fmt::print("{} {}; compiling and judging took\n",
             counted(static_cast<double>(records.size()), "submission"),
             missing == 0 ? "graded" : fmt::format("taken in, {} of them without marks", missing));
  for (const CourseLab& lab : labs)
    fmt::print("{}", costs(records, lab));
  fmt::print("marks: {}\n", (out / "class.csv").string());
  if (page) fmt::print("what the class did not understand: {}\n", (out / "class.html").string());
}

void check_class(const std::vector<Record>& records, const Submissions& submissions) {
  const auto failures = unfinished(records);
  const std::size_t renamed = tell_renamed(submissions.sources);
  const std::size_t left_out = tell_left_out(submissions.left_out);
  if (failures == 0 && renamed > 0) {
    throw Error(
        "{} submissions have names that others have: class.csv says in its last column "
        "where each was found",
        renamed);
  }
  if (failures == 0 && left_out > 0) {
    throw Error(
        "not all that stands beside the submissions is one ({} files): take it away, or make folders",
        left_out);
  }
  if (failures == 0) return;
  throw Error(
      "{} submissions could not be graded: run the same command again, or see their "
      "report.txt",
      failures);
}

}  // namespace carlo::grader
