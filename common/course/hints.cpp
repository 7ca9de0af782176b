#include "course/hints.h"

#include "cli/atomic_file.h"
#include "cli/error.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <system_error>

namespace carlo {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string numbers(const Lab& lab) {
  return fmt::format("{} to {}", lab.exercises.front().number(), lab.exercises.back().number());
}

/// The number before the point of "1.2"; 0 when it is no number.
int lab_of(const std::string& number) {
  int lab = 0;
  std::from_chars(number.data(), number.data() + number.size(), lab);
  return lab;
}

std::string heading(const Exercise& exercise) {
  return fmt::format("{}: {} (lecture: {})\n", exercise.tag, exercise.title, exercise.lecture);
}

const std::string& text_of(const Exercise& exercise, int step) {
  return exercise.hints[static_cast<std::size_t>(step - 1)];
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
  if (lab_of(number) == 0) throw Error("an exercise is a number such as 1.2, got \"{}\"", typed);
  const Lab& lab = find_lab(labs, lab_of(number));
  if (number.find('.') == std::string::npos) {
    throw Error("which exercise of lab {}? There are {}", lab.number, numbers(lab));
  }
  throw Error("there is no exercise {}; lab {} has {}", typed, lab.number, numbers(lab));
}

std::string next_hint(const Exercise& exercise, HintState& state) {
  const int count = static_cast<int>(exercise.hints.size());
  if (count == 0) throw Error("{} has no hints", exercise.tag);
  const int seen = state.seen(exercise);
  const int shown = std::min(seen + 1, count);
  if (shown != seen) state.set_seen(exercise, shown);
  const std::string next =
      seen >= count ? fmt::format(
                          "there are no more (all: ./carlo hint {} --all); see the handout "
                          "and the header",
                          exercise.number())
      : shown == count ? "the last"
                       : "run again for the next";
  return fmt::format("{}hint {} of {}; {}\n\n{}\n", heading(exercise), shown, count, next,
                     text_of(exercise, shown));
}

std::string seen_hint(const Exercise& exercise, int step, const HintState& state) {
  const int count = static_cast<int>(exercise.hints.size());
  if (step < 1 || step > count) {
    throw Error("{} has hints 1 to {}, got {}", exercise.tag, count, step);
  }
  const int seen = std::min(state.seen(exercise), count);
  if (step > seen) {
    throw Error("hint {} of {} has not been seen yet; ./carlo hint {} shows hint {}", step,
                exercise.tag, exercise.number(), seen + 1);
  }
  return fmt::format("{}hint {} of {}\n\n{}\n", heading(exercise), step, count,
                     text_of(exercise, step));
}

std::string seen_hints(const Exercise& exercise, const HintState& state) {
  const int count = static_cast<int>(exercise.hints.size());
  const int seen = std::min(state.seen(exercise), count);
  if (seen == 0) {
    throw Error("no hint of {} has been seen yet; ./carlo hint {} shows the first", exercise.tag,
                exercise.number());
  }
  std::string out = heading(exercise);
  for (int step = 1; step <= seen; ++step) {
    out += fmt::format("{}hint {} of {}\n\n{}\n", step > 1 ? "\n" : "", step, count,
                       text_of(exercise, step));
  }
  return out;
}

}  // namespace carlo
