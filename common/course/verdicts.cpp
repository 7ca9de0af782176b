#include "course/verdicts.h"

#include "cli/atomic_file.h"
#include "cli/error.h"
#include "verdict/verdict_json.h"

#include <nlohmann/json.hpp>

#include <system_error>

namespace carlo {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

}  // namespace

VerdictBook::VerdictBook(fs::path file) : file_(std::move(file)) {
  if (!fs::exists(file_)) return;
  const std::string text = read_file(file_);
  try {
    const json document = json::parse(text);
    for (const auto& [number, entry] : document.at("exercises").items())
      verdicts_[number] = {exercise_result_from_json(entry.at("judged")), entry.at("exercise")};
  } catch (const std::exception&) {
    throw Error("{}: not a record of verdicts; remove it to start afresh", file_.string());
  }
}

const KeptVerdict* VerdictBook::find(const Exercise& exercise) const {
  const auto found = verdicts_.find(exercise.number());
  return found == verdicts_.end() ? nullptr : &found->second;
}

void VerdictBook::take(const LabResult& judged, const Lab& lab, const OwnCode& code) {
  if (judged.lab != lab.number) throw Error("verdicts of another lab");
  for (const ExerciseResult& result : judged.exercises) {
    const Exercise* exercise = lab.find(result.tag);
    if (exercise == nullptr) throw Error("verdicts of an exercise that lab.json does not list");
    verdicts_[exercise->number()] = {result, code.digest(*exercise)};
  }
}

void VerdictBook::save() const {
  json exercises = json::object();
  for (const auto& [number, verdict] : verdicts_)
    exercises[number] = {{"judged", to_json(verdict.result)}, {"exercise", verdict.exercise}};
  std::error_code ec;
  if (file_.has_parent_path()) fs::create_directories(file_.parent_path(), ec);
  write_file(file_, dumped({{"exercises", exercises}}, 1) + "\n");
}

}  // namespace carlo
