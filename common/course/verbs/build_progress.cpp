#include "course/verbs/build_progress.h"

#include "course/verbs/words.h"

#include <unistd.h>

#include <cstdio>

namespace carlo::verbs {

std::string time_left(int done, int total, int seconds) {
  if (seconds < 3 || done < 5) return "";
  const int left = seconds * (total - done) / done;
  if (left < 90) return joined({", about ", std::to_string(left / 10 * 10 + 10), " s left"});
  return joined({", about ", std::to_string((left + 30) / 60), " min left"});
}

BuildProgress::BuildProgress() : terminal_(::isatty(STDERR_FILENO) == 1) {}

bool BuildProgress::takes(const std::string& line) {
  if (line.empty() || line[0] != '@') return false;
  int done = 0, total = 0;
  double seconds = 0;
  if (std::sscanf(line.c_str(), "@%d/%d %lf", &done, &total, &seconds) != 3) return false;
  const int second = static_cast<int>(seconds);
  const std::string told = joined({"carlo: building ", std::to_string(done), "/",
                                   std::to_string(total), time_left(done, total, second)});
  if (terminal_) {
    shown_ = true;
    say({"\r\x1b[K", told});
  } else if (second - told_ >= 30) {
    told_ = second;
    say({told, "\n"});
  }
  return true;
}

void BuildProgress::clear() {
  if (shown_) say({"\r\x1b[K"});
  shown_ = false;
}

}  // namespace carlo::verbs
