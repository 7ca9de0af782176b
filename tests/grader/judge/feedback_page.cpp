#include "grader/judge/feedback_page.h"

#include "grader/page/grade_page.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>

#include <filesystem>

namespace carlo::grader {
namespace {

/// Returns the lab's number, or that of its only exercise: no lab has so few.
std::string what_was_judged(const LabResult& lab) {
  return lab.exercises.size() == 1 ? lab.exercises.front().number() : std::to_string(lab.lab);
}

std::string page_of(const LabResult& lab) {
  PageWords words{fmt::format("Lab {:02}: {}", lab.lab, lab.title)};
  words.subtitle = fmt::format("What the tests say of your code: {} of {} points",
                               points_text(lab.earned()), lab.possible());
  // Without --seed the numbers are the same each time.
  const std::string option = lab.usual_seed ? "" : fmt::format(" --seed {}", lab.seed);
  words.facts = {{"Again", fmt::format("./carlo test {}{}", what_was_judged(lab), option)},
                 {"Sandbox", lab.sandbox}};
  return grade_page({{lab}}, words);
}

void write(const std::filesystem::path& path, const std::string& html) {
  std::error_code failed;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), failed);
  if (failed) {
    throw Error("cannot make the folder {}: {}", path.parent_path().string(), failed.message());
  }
  write_file(path, html);
  fmt::print("The page with the pictures: {}\n",
             std::filesystem::absolute(path).lexically_normal().string());
}

}  // namespace

void write_feedback_page(const LabResult& lab, const PageFiles& files) {
  if (files.always.empty() && files.on_failure.empty()) return;
  const std::string html = page_of(lab);
  if (!files.always.empty()) write(files.always, html);
  if (files.on_failure.empty()) return;
  if (something_failed(lab) || std::filesystem::exists(files.on_failure)) {
    write(files.on_failure, html);
  }
}

}  // namespace carlo::grader
