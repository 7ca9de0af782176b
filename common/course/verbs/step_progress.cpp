#include "course/verbs/step_progress.h"

#include "course/verbs/words.h"
#include "support/number.h"

#include <unistd.h>

#include <algorithm>
#include <utility>

namespace carlo::verbs {
namespace {

/// Returns "3/10, about 3 min left" after that many seconds, of which `waited` since the last step;
/// without the estimate while it would be a guess, or where one step takes longer than it; "..."
/// before the number of steps is known.
std::string in_words(const Step& step, int seconds, int waited) {
  if (step.total == 0) return "...";
  std::string text = joined({std::to_string(step.done), "/", std::to_string(step.total)});
  if (seconds < 3 || step.done < 5 || step.done == step.total) return text;
  const int left = seconds * (step.total - step.done) / step.done;
  if (waited > left) return text;
  if (left < 90) return joined({text, ", about ", std::to_string(left / 10 * 10 + 10), " s left"});
  return joined({text, ", about ", std::to_string((left + 30) / 60), " min left"});
}

}  // namespace

std::optional<Step> step_in(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  const std::size_t slash = text.find('/'), blank = text.find(' ');
  if (slash > blank || blank == std::string_view::npos) return std::nullopt;
  const auto done = number_of<int>(text.substr(0, slash));
  const auto total = number_of<int>(text.substr(slash + 1, blank - slash - 1));
  if (!done || !total) return std::nullopt;
  return Step{*done, *total};
}

StepProgress::StepProgress(std::string doing)
    : doing_(std::move(doing)), terminal_(::isatty(STDERR_FILENO) == 1) {}

void StepProgress::report(const Step& step) {
  step_ = step;
  last_step_ = Clock::now();
  show();
}

void StepProgress::show() {
  const auto now = Clock::now();
  const auto seconds_since = [&](Clock::time_point then) {
    return static_cast<int>(std::chrono::duration_cast<std::chrono::seconds>(now - then).count());
  };
  const std::string text = joined(
      {"carlo: ", doing_, " ", in_words(step_, seconds_since(start_), seconds_since(last_step_))});
  if (terminal_) {
    shown_ = true;
    say({"\r\x1b[K", text});
  } else if (now - last_line_ >= std::chrono::seconds(10)) {
    last_line_ = now;
    say({text, "\n"});
  }
}

void StepProgress::clear() {
  if (shown_) say({"\r\x1b[K"});
  shown_ = false;
}

}  // namespace carlo::verbs
