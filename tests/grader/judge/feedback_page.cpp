#include "grader/judge/feedback_page.h"

#include "cli/atomic_file.h"
#include "cli/error.h"
#include "grader/judge/run.h"
#include "grader/page/grade_page.h"
#include "grader/page/text.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace carlo::grader {
namespace {

/// The lab's number, or that of the one exercise: no lab has so few.
std::string what_was_judged(const nlohmann::json& lab, const std::string& number) {
  const auto exercises = lab.find("exercises");
  if (exercises == lab.end() || exercises->size() != 1) return number;
  const std::string tag = text_in(exercises->front(), "tag");
  const std::string prefix = "Lab ";
  return tag.starts_with(prefix) ? tag.substr(prefix.size()) : number;
}

std::string page_of(const nlohmann::json& lab) {
  const std::string number = number_in(lab, "lab");
  PageWords words{
      fmt::format("Lab {}{}: {}", number.size() == 1 ? "0" : "", number, text_in(lab, "title"))};
  words.subtitle = fmt::format("What the tests say of your code: {} of {} points",
                               number_in(lab, "points"), number_in(lab, "max"));
  // Without --seed the numbers are the same each time.
  const std::string seed = text_in(lab, "seed");
  const std::string option = seed == std::to_string(local_seed()) ? "" : " --seed " + seed;
  words.facts = {{"Again", fmt::format("./carlo test {}{}", what_was_judged(lab, number), option)},
                 {"Sandbox", text_in(lab, "sandbox")}};
  return grade_page(lab, words);
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

void write_feedback_page(const std::string& verdicts, const PageFiles& files) {
  if (files.always.empty() && files.on_failure.empty()) return;
  const auto lab = nlohmann::json::parse(verdicts);
  const std::string html = page_of(lab);
  if (!files.always.empty()) write(files.always, html);
  if (files.on_failure.empty()) return;
  if (something_failed(lab) || std::filesystem::exists(files.on_failure)) {
    write(files.on_failure, html);
  }
}

}  // namespace carlo::grader
