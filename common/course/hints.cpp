#include "course/hints.h"

#include "cli/atomic_file.h"
#include "cli/error.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <system_error>

namespace carlo {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string numbers(const Lab& lab) {
  std::vector<std::string> list;
  std::transform(lab.exercises.begin(), lab.exercises.end(), std::back_inserter(list),
                 [](const Exercise& exercise) { return exercise.number(); });
  return fmt::format("{}", fmt::join(list, ", "));
}

/// The number before the point of "1.2"; 0 when it is no number.
int lab_of(const std::string& number) {
  int lab = 0;
  std::from_chars(number.data(), number.data() + number.size(), lab);
  return lab;
}

}  // namespace

HintState::HintState(fs::path file) : file_(std::move(file)), text_("{}") {
  if (!fs::exists(file_)) return;
  text_ = read_file(file_);
  const json state = json::parse(text_, nullptr, false);
  const bool good = state.is_object() && (!state.contains("hints") || state["hints"].is_object());
  if (!good) throw Error("{}: not a record of hints; remove it to start afresh", file_.string());
}

int HintState::seen(const Exercise& exercise) const {
  const json state = json::parse(text_);
  const json count = state.value("hints", json::object()).value(exercise.number(), json(0));
  return count.is_number_integer() ? std::clamp(count.get<int>(), 0, 1000) : 0;
}

void HintState::set_seen(const Exercise& exercise, int count) {
  json state = json::parse(text_);
  state["hints"][exercise.number()] = count;
  text_ = state.dump(2) + "\n";
  std::error_code ec;
  if (file_.has_parent_path()) fs::create_directories(file_.parent_path(), ec);
  write_file(file_, text_);
}

const Exercise& find_exercise(const std::vector<Lab>& labs, const std::string& typed) {
  const std::string number = typed.rfind("Lab ", 0) == 0 ? typed.substr(4) : typed;
  for (const Lab& lab : labs) {
    if (const Exercise* exercise = lab.find("Lab " + number)) return *exercise;
  }
  for (const Lab& lab : labs) {
    if (lab.number != lab_of(number)) continue;
    throw Error("there is no exercise {}; lab {} has {}", typed, lab.number, numbers(lab));
  }
  std::vector<std::string> all;
  std::transform(labs.begin(), labs.end(), std::back_inserter(all), numbers);
  throw Error("there is no exercise {}; the exercises are {}", typed, fmt::join(all, ", "));
}

std::string next_hint(const Exercise& exercise, HintState& state) {
  const int count = static_cast<int>(exercise.hints.size());
  if (count == 0) throw Error("{} has no hints", exercise.tag);
  const int seen = state.seen(exercise);
  const int shown = std::min(seen + 1, count);
  if (shown != seen) state.set_seen(exercise, shown);
  const char* next = seen >= count    ? "there are no more; the handout has the derivation"
                     : shown == count ? "the last"
                                      : "run again for the next";
  return fmt::format("{}: {} (lecture: {})\nhint {} of {}; {}\n\n{}\n", exercise.tag,
                     exercise.title, exercise.lecture, shown, count, next,
                     exercise.hints[static_cast<std::size_t>(shown - 1)]);
}

}  // namespace carlo
