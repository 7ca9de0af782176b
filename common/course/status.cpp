#include "course/status.h"

#include "cli/terminal.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace carlo {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Characters: bytes of UTF-8 that start one.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

const char* name_of(Stage stage) {
  switch (stage) {
    case Stage::untouched:
      return "not begun";
    case Stage::begun:
      return "begun";
    case Stage::edited:
      return "edited since judged";
    case Stage::failed:
      return "not right yet";
    case Stage::passed:
      return "done";
  }
  return "";
}

std::string mark(Stage stage) {
  switch (stage) {
    case Stage::untouched:
      return coloured(Colour::dim, "–");
    case Stage::begun:
    case Stage::edited:
      return coloured(Colour::yellow, "~");
    case Stage::failed:
      return coloured(Colour::red, "✗");
    case Stage::passed:
      return coloured(Colour::green, "✓");
  }
  return "";
}

Stage stage_of(const ExerciseStatus& status, const KeptVerdict* verdict, const OwnCode& code) {
  const Exercise& exercise = *status.exercise;
  const auto functions = static_cast<int>(exercise.functions.size());
  // Whatever an older verdict says: the stub is back.
  if (status.open > 0 && status.open >= functions) return Stage::untouched;
  if (verdict == nullptr) return Stage::begun;
  if (age_of(*verdict, exercise, code) == Age::edited) {
    const bool was_open = verdict->status == "not_implemented";
    return was_open || status.open > 0 ? Stage::begun : Stage::edited;
  }
  if (verdict->status == "not_implemented") return Stage::begun;
  return verdict->status == "passed" ? Stage::passed : Stage::failed;
}

/// What the line says behind the points.
std::string remark(const ExerciseStatus& status) {
  const Exercise& exercise = *status.exercise;
  std::string text;
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  if (status.stage != Stage::passed) add(name_of(status.stage));
  if (status.stage == Stage::begun && status.open > 0) {
    add(fmt::format("{} of {} functions to do", status.open, exercise.functions.size()));
  } else if (status.stage == Stage::begun) {
    add("not judged yet");
  }
  if (status.stage == Stage::passed && status.rest_edited) {
    add("other exercises were edited since");
  }
  if (status.hints > 0) {
    add(fmt::format("{} of {} hints seen", status.hints, exercise.hints.size()));
  }
  return text;
}

std::string bar(double points, int possible) {
  if (!stdout_has_colour()) return "";
  constexpr int cells = 20;
  const int full = possible > 0 ? static_cast<int>(std::lround(cells * points / possible)) : 0;
  std::string text;
  for (int i = 0; i < cells; ++i)
    text += i < full ? "█" : "░";
  return coloured(full == cells ? Colour::green : Colour::blue, text) + "  ";
}

std::string next_line(const Exercise* next) {
  if (next == nullptr) return coloured(Colour::green, "Everything is done.") + "\n";
  const std::string lab = next->number().substr(0, next->number().find('.'));
  return fmt::format("{} {}, {}: ./carlo watch {}, ./carlo hint {}\n",
                     coloured(Colour::bold, "Next:"), next->tag, next->title, lab, next->number());
}

}  // namespace

double LabStatus::points() const {
  double sum = 0;
  for (const ExerciseStatus& exercise : exercises)
    sum += exercise.points;
  return sum;
}

int LabStatus::passed() const {
  return static_cast<int>(std::count_if(
      exercises.begin(), exercises.end(),
      [](const ExerciseStatus& exercise) { return exercise.stage == Stage::passed; }));
}

bool LabStatus::begun() const {
  return std::any_of(exercises.begin(), exercises.end(), [](const ExerciseStatus& exercise) {
    return exercise.stage != Stage::untouched;
  });
}

LabStatus status_of(const Lab& lab, const fs::path& labs, const VerdictBook& book,
                    const HintState& hints) {
  const OwnCode code(labs, lab);
  LabStatus result{&lab, {}};
  for (const Exercise& exercise : lab.exercises) {
    ExerciseStatus status;
    status.exercise = &exercise;
    status.open = code.open_functions(exercise);
    status.hints = std::min(hints.seen(exercise), static_cast<int>(exercise.hints.size()));
    const KeptVerdict* verdict = book.find(exercise);
    status.stage = stage_of(status, verdict, code);
    if (verdict != nullptr && status.stage != Stage::untouched) {
      status.points = std::min(verdict->points, static_cast<double>(exercise.points));
      status.rest_edited = age_of(*verdict, exercise, code) == Age::rest_edited;
      status.message = status.stage == Stage::failed ? verdict->message : "";
    }
    result.exercises.push_back(std::move(status));
  }
  return result;
}

const Exercise* next_exercise(const LabStatus& lab, const Exercise* after) {
  const auto open = [](const ExerciseStatus& status) { return status.stage != Stage::passed; };
  const auto first = lab.exercises.begin(), last = lab.exercises.end();
  const auto here = std::find_if(
      first, last, [&](const ExerciseStatus& status) { return status.exercise == after; });
  auto found = std::find_if(here == last ? first : here + 1, last, open);
  if (found == last) found = std::find_if(first, last, open);
  return found == last ? nullptr : found->exercise;
}

const Exercise* next_exercise(const std::vector<LabStatus>& labs) {
  for (const LabStatus& lab : labs) {
    if (const Exercise* next = next_exercise(lab)) return next;
  }
  return nullptr;
}

std::size_t title_width(const Lab& lab) {
  std::size_t widest = 0;
  for (const Exercise& exercise : lab.exercises)
    widest = std::max(widest, width(exercise.title));
  return widest;
}

std::string status_line(const ExerciseStatus& status, std::size_t titles) {
  const Exercise& exercise = *status.exercise;
  const std::string gap(titles - std::min(titles, width(exercise.title)), ' ');
  const std::string had = status.stage == Stage::edited ? "had " : "";
  std::string line = fmt::format("{} {}  {}{}  {}{:g} of {}", mark(status.stage), exercise.number(),
                                 exercise.title, gap, had, status.points, exercise.points);
  if (const std::string more = remark(status); !more.empty()) {
    line += "  " + coloured(Colour::dim, more);
  }
  return line;
}

std::string status_heading(const LabStatus& status) {
  const int possible = status.lab->points();
  return fmt::format("{}  {}{:g} of {} points, {} of {} exercises  {}",
                     coloured(Colour::bold, fmt::format("Lab {:02}", status.lab->number)),
                     bar(status.points(), possible), status.points(), possible, status.passed(),
                     status.exercises.size(), status.lab->title);
}

std::string status_text(const std::vector<LabStatus>& labs, bool all) {
  const Exercise* next = next_exercise(labs);
  std::string text;
  double points = 0;
  int possible = 0, passed = 0;
  std::size_t exercises = 0;
  for (const LabStatus& lab : labs) {
    text += status_heading(lab) + "\n";
    points += lab.points();
    possible += lab.lab->points();
    passed += lab.passed();
    exercises += lab.exercises.size();
    const bool is_next = next != nullptr && lab.lab->find(next->tag) == next;
    const bool open = lab.begun() && lab.passed() < static_cast<int>(lab.exercises.size());
    if (!all && !is_next && !open) continue;
    for (const ExerciseStatus& exercise : lab.exercises)
      text += "  " + status_line(exercise, title_width(*lab.lab)) + "\n";
  }
  if (labs.size() > 1) {
    text += fmt::format("In all: {:g} of {} points, {} of {} exercises\n", points, possible, passed,
                        exercises);
  }
  return text + next_line(next);
}

std::string status_json(const std::vector<LabStatus>& labs) {
  json document{{"labs", json::array()}};
  double points = 0;
  int possible = 0;
  for (const LabStatus& lab : labs) {
    json exercises = json::array();
    for (const ExerciseStatus& status : lab.exercises) {
      const Exercise& exercise = *status.exercise;
      exercises.push_back({{"tag", exercise.tag},
                           {"title", exercise.title},
                           {"stage", name_of(status.stage)},
                           {"points", status.points},
                           {"max", exercise.points},
                           {"open_functions", status.open},
                           {"rest_edited", status.rest_edited},
                           {"hints_seen", status.hints},
                           {"hints", exercise.hints.size()},
                           {"message", status.message}});
    }
    document["labs"].push_back({{"lab", lab.lab->number},
                                {"title", lab.lab->title},
                                {"points", lab.points()},
                                {"max", lab.lab->points()},
                                {"exercises", exercises}});
    points += lab.points();
    possible += lab.lab->points();
  }
  const Exercise* next = next_exercise(labs);
  document["points"] = points;
  document["max"] = possible;
  document["next"] = next == nullptr ? json(nullptr) : json(next->number());
  return document.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace carlo
