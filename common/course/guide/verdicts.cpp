#include "course/guide/verdicts.h"

#include "course/verdict/verdict_json.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <system_error>

namespace carlo {

namespace fs = std::filesystem;

static void fields(JsonFields& json, KeptVerdict& verdict) {
  json("judged", verdict.result);
  json("exercise", verdict.exercise);
}

namespace {

/// The content of the file.
struct Kept {
  std::map<std::string, KeptVerdict> exercises;
};

void fields(JsonFields& json, Kept& kept) {
  json("exercises", kept.exercises);
}

}  // namespace

Stage stage_of(const Exercise& exercise, const OwnCode& code, const KeptVerdict* verdict) {
  const int open = code.open_functions(exercise);
  // The stub is back, so an older verdict no longer counts.
  if (open > 0 && open >= static_cast<int>(exercise.functions.size())) return Stage::untouched;
  if (verdict == nullptr) return Stage::begun;
  const bool changed = verdict->exercise != code.digest(exercise);
  if (verdict->result.status == Status::not_implemented || (changed && open > 0))
    return Stage::begun;
  if (verdict->passed()) return Stage::passed;
  return changed ? Stage::edited : Stage::failed;
}

VerdictBook::VerdictBook(fs::path file) : file_(std::move(file)) {
  if (!fs::exists(file_)) return;
  const std::string text = read_file(file_);
  try {
    verdicts_ = from_json_text<Kept>(text, "verdicts").exercises;
  } catch (const Error&) {
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
    KeptVerdict& kept = verdicts_[exercise->number()] = {result, code.digest(*exercise)};
    for (TestRecord& test : kept.result.tests)
      for (Verdict& verdict : test.verdicts)
        verdict.figure.reset();
  }
}

void VerdictBook::save() const {
  std::error_code ec;
  if (file_.has_parent_path()) fs::create_directories(file_.parent_path(), ec);
  write_file(file_, json_text(Kept{verdicts_}, 1) + "\n");
}

}  // namespace carlo
