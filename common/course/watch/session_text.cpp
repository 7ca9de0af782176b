// The texts of a session.

#include "course/verdict/verdict_text.h"
#include "course/watch/session.h"
#include "support/terminal.h"

#include <fmt/core.h>

#include <algorithm>

namespace carlo {
namespace {

/// Returns an exercise's entry in the row of all exercises.
std::string chip(const ExerciseStatus& status, bool current) {
  const std::string number = status.exercise->number();
  std::string text;
  switch (status.stage) {
    case Stage::passed:
      text = coloured(status.changed ? Colour::yellow : Colour::green, "✓ " + number);
      break;
    case Stage::failed:
      text = coloured(Colour::red, "✗ " + number);
      break;
    case Stage::begun:
    case Stage::edited:
      text = coloured(Colour::yellow, "~ " + number);
      break;
    case Stage::untouched:
      text = coloured(Colour::dim, "– " + number);
      break;
  }
  return current ? "[" + text + "]" : " " + text + " ";
}

}  // namespace

std::string WatchSession::activity() const {
  const std::string what = all_ ? fmt::format("lab {}", lab_.number) : current_->tag;
  if (phase_ == Phase::building) return fmt::format("building for {} ...", what);
  if (phase_ == Phase::judging) return fmt::format("judging {} ...", what);
  return "";
}

std::string WatchSession::heading() const {
  const LabStatus now = status();
  std::string text = status_heading(now) + "\n";
  for (const ExerciseStatus& exercise : now.exercises)
    text += chip(exercise, exercise.exercise == current_);
  return text + "\n";
}

std::string WatchSession::next_text(bool from_current) const {
  const LabStatus now = status();
  const auto is_open = [&](const ExerciseStatus& status) {
    return status.exercise == current_ && status.stage != Stage::passed;
  };
  const bool here =
      from_current && std::any_of(now.exercises.begin(), now.exercises.end(), is_open);
  if (const Exercise* next = here ? current_ : next_open()) {
    return fmt::format("{} {}, {}\n", coloured(Colour::bold, "Next:"), next->tag, next->title);
  }
  if (now.changed() > 0) {
    return fmt::format("Lab {} was done; press a to judge what has changed since.\n", lab_.number);
  }
  return coloured(Colour::green, fmt::format("Lab {} is done.", lab_.number)) +
         fmt::format(" ./carlo lab {} runs its experiments, ./carlo status says what is next.\n",
                     lab_.number);
}

std::string WatchSession::list_text(bool from_current) const {
  const LabStatus now = status();
  std::string text;
  const std::size_t titles = title_width(now);
  for (const ExerciseStatus& exercise : now.exercises)
    text += status_line(exercise, titles) + "\n";
  return text + next_text(from_current);
}

bool WatchSession::changed_since(const Exercise& exercise) const {
  const LabStatus now = status();
  return std::any_of(now.exercises.begin(), now.exercises.end(), [&](const ExerciseStatus& of) {
    return of.exercise == &exercise && of.changed;
  });
}

std::string WatchSession::verdict_text(const Exercise& exercise) const {
  const KeptVerdict* verdict = book_.find(exercise);
  const std::string title = fmt::format("{}, {}", exercise.tag, exercise.title);
  if (verdict == nullptr) return title + "\n";
  std::string points = fmt::format("{:g} of {} points", verdict->result.points, exercise.points);
  const bool changed = changed_since(exercise);
  if (changed) points += coloured(Colour::dim, ", before this change");
  if (verdict->passed()) {
    return fmt::format("{} {}: {}\n", coloured(changed ? Colour::dim : Colour::green, "✓"), title,
                       points);
  }
  const bool open = verdict->result.status == Status::not_implemented;
  const std::string mark = open ? coloured(Colour::yellow, "–") : coloured(Colour::red, "✗");
  // The key shows the current exercise's hint.
  const Help help = &exercise == current_ ? Help::by_key : Help::typed;
  return fmt::format("{} {}: {}\n{}", mark, title, points, shortfall(verdict->result, help));
}

std::string WatchSession::verdicts_text() const {
  if (all_) return list_text(true);
  std::string text;
  bool passed = true;
  for (const Exercise* exercise : which_) {
    const KeptVerdict* verdict = book_.find(*exercise);
    passed = passed && verdict != nullptr && verdict->passed();
    text += verdict_text(*exercise);
  }
  return text + (passed ? next_text() : "");
}

std::string WatchSession::body() const {
  if (panel_ == Panel::hint) return hint_ + "\n" + last_run();
  return panel_ == Panel::list ? list_text() : last_run();
}

std::string WatchSession::last_run() const {
  if (!has_run_) return "";
  const std::size_t most = whole_ ? messages_.size() : compiles_ ? 1 : 2;
  std::string text;
  if (compiles_ && trouble_.empty()) {
    // First, because the end may be cut: it shows that the verdict is new.
    text = coloured(Colour::dim,
                    fmt::format("{:.1f} s: build {:.1f}, tests {:.1f}",
                                build_seconds_ + judge_seconds_, build_seconds_, judge_seconds_)) +
           "\n" + verdicts_text();
  } else if (!compiles_) {
    text = coloured(Colour::red, "✗") + " the code does not compile\n";
  }
  return text + trouble_ + compiler_text(messages_, most);
}

}  // namespace carlo
