#include "course/verbs/build_progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>

namespace carlo::verbs {

std::string time_left(int done, int total, int seconds) {
  if (seconds < 3 || done < 5) return "";
  const int left = seconds * (total - done) / done;
  if (left < 90) return ", about " + std::to_string(left / 10 * 10 + 10) + " s left";
  return ", about " + std::to_string((left + 30) / 60) + " min left";
}

BuildProgress::BuildProgress() : terminal_(::isatty(STDERR_FILENO) == 1) {}

bool BuildProgress::takes(const std::string& line) {
  if (line.empty() || line[0] != '@') return false;
  int done = 0, total = 0;
  double seconds = 0;
  if (std::sscanf(line.c_str(), "@%d/%d %lf", &done, &total, &seconds) != 3) return false;
  const int second = static_cast<int>(seconds);
  const std::string steps = std::to_string(done) + "/" + std::to_string(total);
  if (terminal_) {
    shown_ = true;
    fmt::print(stderr, "\r\x1b[Kcarlo: building {}{}", steps, time_left(done, total, second));
  } else if (second - told_ >= 30) {
    told_ = second;
    fmt::print(stderr, "carlo: building {}{}\n", steps, time_left(done, total, second));
  }
  return true;
}

void BuildProgress::clear() {
  if (shown_) fmt::print(stderr, "\r\x1b[K");
  shown_ = false;
}

}  // namespace carlo::verbs
