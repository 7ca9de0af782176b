#include "course/guide/status.h"

#include "course/cli/wrap.h"
#include "course/json/json_fields.h"
#include "course/verdict/verdict_text.h"
#include "support/terminal.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace carlo {
namespace {

namespace fs = std::filesystem;

const char* name_of(Stage stage) {
  switch (stage) {
    case Stage::untouched:
      return "not begun";
    case Stage::begun:
      return "begun";
    case Stage::edited:
      return "changed since judged";
    case Stage::failed:
      return "not right yet";
    case Stage::passed:
      return "done";
  }
  return "";
}

std::string mark(const ExerciseStatus& status) {
  switch (status.stage) {
    case Stage::untouched:
      return coloured(Colour::dim, "–");
    case Stage::begun:
    case Stage::edited:
      return coloured(Colour::yellow, "~");
    case Stage::failed:
      return coloured(Colour::red, "✗");
    case Stage::passed:
      return coloured(status.changed ? Colour::yellow : Colour::green, "✓");
  }
  return "";
}

/// Returns the remark behind the points.
std::string remark(const ExerciseStatus& status) {
  const Exercise& exercise = *status.exercise;
  std::string text;
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  // For the other stages the mark and the points are enough; a line should fit into 80 columns.
  if (status.stage == Stage::begun && status.open > 0) {
    add(fmt::format("{} of {} functions to do", status.open, exercise.functions.size()));
  } else if (status.stage == Stage::begun) {
    add("not judged yet");
  } else if (status.stage == Stage::edited || status.stage == Stage::failed) {
    add(name_of(status.stage));
  }
  if (status.stage == Stage::passed && status.changed) add("changed since");
  if (status.hints > 0) {
    add(fmt::format("hint {} of {}", status.hints, exercise.hints.size()));
  }
  return text.empty() ? "" : "  " + text;
}

std::string points(const ExerciseStatus& status) {
  const char* had = status.stage == Stage::edited ? "had " : "";
  return fmt::format("  {}{:g} of {}", had, status.points, status.exercise->points);
}

/// The width of an exercise's line without its title; includes the indentation and the mark.
std::size_t beside_title(const ExerciseStatus& status) {
  return 6 + display_width(status.exercise->number()) + display_width(points(status)) +
         display_width(remark(status));
}

std::string bar(double points, int possible) {
  if (!stdout_has_colour()) return "";
  constexpr int cells = 10;
  const int full = possible > 0 ? static_cast<int>(std::lround(cells * points / possible)) : 0;
  std::string text;
  for (int i = 0; i < cells; ++i)
    text += i < full ? "█" : "░";
  return coloured(full == cells ? Colour::green : Colour::blue, text) + "  ";
}

std::string next_line(const std::vector<LabStatus>& labs) {
  const Exercise* next = next_exercise(labs);
  if (next == nullptr) {
    const auto changed = std::find_if(labs.begin(), labs.end(),
                                      [](const LabStatus& lab) { return lab.changed() > 0; });
    const std::string done = labs.size() == 1
                                 ? fmt::format("Lab {} is done.", labs.front().lab->number)
                                 : "Everything is done.";
    return coloured(Colour::green, done) + (changed == labs.end()
                                                ? "\n"
                                                : fmt::format(" To judge what has changed since: "
                                                              "./carlo test {}\n",
                                                              changed->lab->number));
  }
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

int LabStatus::changed() const {
  return static_cast<int>(
      std::count_if(exercises.begin(), exercises.end(), [](const ExerciseStatus& exercise) {
        return exercise.stage == Stage::passed && exercise.changed;
      }));
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
    status.changed = verdict != nullptr && verdict->exercise != code.digest(exercise);
    status.stage = stage_of(exercise, code, verdict);
    const bool counts = status.stage != Stage::untouched && status.stage != Stage::begun;
    if (verdict != nullptr && counts) {
      status.points = std::min(verdict->result.points, static_cast<double>(exercise.points));
      status.message = status.stage == Stage::failed ? message(verdict->result) : "";
    }
    result.exercises.push_back(std::move(status));
  }
  return result;
}

const Exercise* next_exercise(const LabStatus& lab) {
  const auto found =
      std::find_if(lab.exercises.begin(), lab.exercises.end(),
                   [](const ExerciseStatus& status) { return status.stage != Stage::passed; });
  return found == lab.exercises.end() ? nullptr : found->exercise;
}

const Exercise* next_exercise(const std::vector<LabStatus>& labs) {
  for (const LabStatus& lab : labs) {
    if (const Exercise* next = next_exercise(lab)) return next;
  }
  return nullptr;
}

std::size_t title_width(const LabStatus& lab) {
  std::size_t widest = 0, others = 0;
  for (const ExerciseStatus& exercise : lab.exercises) {
    widest = std::max(widest, display_width(exercise.exercise->title));
    others = std::max(others, beside_title(exercise));
  }
  return std::min(widest, room_beside(others, 16));
}

std::string status_line(const ExerciseStatus& status, std::size_t titles) {
  const Exercise& exercise = *status.exercise;
  const std::string title = shortened(exercise.title, titles);
  const std::string gap(titles - std::min(titles, display_width(title)), ' ');
  const std::string more = remark(status);
  return fmt::format("{} {}  {}{}{}{}", mark(status), exercise.number(), title, gap, points(status),
                     more.empty() ? "" : coloured(Colour::dim, more));
}

std::string status_heading(const LabStatus& status) {
  const int possible = status.lab->points();
  const std::string changed =
      status.changed() > 0 ? fmt::format(" ({} changed since)", status.changed()) : "";
  const std::string done = fmt::format("{:g} of {} points, {} of {} exercises{}", status.points(),
                                       possible, status.passed(), status.exercises.size(), changed);
  constexpr std::size_t number_and_bar = 22;
  const std::size_t room = room_beside(number_and_bar + display_width(done), 0);
  constexpr std::size_t telling = 16;
  const std::string title =
      room < telling ? ""
                     : shortened(status.lab->title.substr(0, status.lab->title.find(':')), room);
  return fmt::format("{}  {}{}  {}",
                     coloured(Colour::bold, fmt::format("Lab {:02}", status.lab->number)),
                     bar(status.points(), possible), done, title);
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
    const bool done = lab.passed() == static_cast<int>(lab.exercises.size());
    const bool open = lab.begun() && (!done || lab.changed() > 0);
    if (!all && !is_next && !open) continue;
    const std::size_t titles = title_width(lab);
    for (const ExerciseStatus& exercise : lab.exercises)
      text += "  " + status_line(exercise, titles) + "\n";
  }
  if (labs.size() > 1) {
    text += fmt::format("In all: {:g} of {} points, {} of {} exercises\n", points, possible, passed,
                        exercises);
  }
  return text + next_line(labs);
}

static void fields(JsonFields& json, const ExerciseStatus& status) {
  const Exercise& exercise = *status.exercise;
  json.also("tag", exercise.tag);
  json.also("title", exercise.title);
  json.also("stage", name_of(status.stage));
  json.also("points", status.points);
  json.also("max", exercise.points);
  json.also("open_functions", status.open);
  json.also("changed", status.changed);
  json.also("hints_seen", status.hints);
  json.also("hints", exercise.hints.size());
  json.also("message", status.message);
}

static void fields(JsonFields& json, const LabStatus& lab) {
  json.also("lab", lab.lab->number);
  json.also("title", lab.lab->title);
  json.also("points", lab.points());
  json.also("max", lab.lab->points());
  json.also("exercises", lab.exercises);
}

static void fields(JsonFields& json, const std::vector<LabStatus>& labs) {
  double points = 0;
  int possible = 0;
  for (const LabStatus& lab : labs) {
    points += lab.points();
    possible += lab.lab->points();
  }
  json.also("labs", labs);
  json.also("points", points);
  json.also("max", possible);
  if (const Exercise* next = next_exercise(labs)) {
    json.also("next", next->number());
  } else {
    json.null("next");
  }
}

std::string status_json(const std::vector<LabStatus>& labs) {
  return json_text(labs, 2) + "\n";
}

}  // namespace carlo
