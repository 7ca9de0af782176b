#include "course/verdicts.h"

#include "cli/atomic_file.h"
#include "cli/error.h"

#include <nlohmann/json.hpp>

#include <system_error>

namespace carlo {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

KeptVerdict verdict_of(const json& entry) {
  KeptVerdict verdict;
  verdict.points = entry.at("points").get<double>();
  verdict.status = entry.at("status").get<std::string>();
  verdict.message = entry.at("message").get<std::string>();
  verdict.text = entry.at("text").get<std::string>();
  verdict.exercise = entry.value("exercise", "");
  return verdict;
}

}  // namespace

VerdictBook::VerdictBook(fs::path file) : file_(std::move(file)) {
  if (!fs::exists(file_)) return;
  try {
    const json document = json::parse(read_file(file_));
    for (const auto& [number, entry] : document.at("exercises").items())
      verdicts_[number] = verdict_of(entry);
  } catch (const json::exception&) {
    throw Error("{}: not a record of verdicts; remove it to start afresh", file_.string());
  }
}

const KeptVerdict* VerdictBook::find(const Exercise& exercise) const {
  const auto found = verdicts_.find(exercise.number());
  return found == verdicts_.end() ? nullptr : &found->second;
}

void VerdictBook::take(const std::string& judged, const Lab& lab, const OwnCode& code) {
  try {
    const json document = json::parse(judged);
    if (document.at("lab").get<int>() != lab.number) throw Error("verdicts of another lab");
    for (const json& entry : document.at("exercises")) {
      const Exercise* exercise = lab.find(entry.at("tag").get<std::string>());
      if (exercise == nullptr) throw Error("verdicts of an exercise that lab.json does not list");
      KeptVerdict verdict = verdict_of(entry);
      verdict.exercise = code.digest(*exercise);
      verdicts_[exercise->number()] = std::move(verdict);
    }
  } catch (const json::exception&) {
    throw Error("lab {}: what should be the judge's verdicts is something else", lab.number);
  }
}

void VerdictBook::save() const {
  json exercises = json::object();
  for (const auto& [number, verdict] : verdicts_) {
    exercises[number] = {{"points", verdict.points},
                         {"status", verdict.status},
                         {"message", verdict.message},
                         {"text", verdict.text},
                         {"exercise", verdict.exercise}};
  }
  std::error_code ec;
  if (file_.has_parent_path()) fs::create_directories(file_.parent_path(), ec);
  write_file(file_, json{{"exercises", exercises}}.dump(1) + "\n");
}

}  // namespace carlo
