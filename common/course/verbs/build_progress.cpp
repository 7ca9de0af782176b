#include "course/verbs/build_progress.h"

#include "course/verbs/words.h"
#include "support/number.h"

#include <unistd.h>

#include <cstddef>
#include <string_view>

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
  // "@DONE/TOTAL SECONDS what"
  const std::size_t slash = line.find('/'), blank = line.find(' ');
  if (slash > blank || blank == std::string::npos) return false;
  const std::string_view text = line;
  const auto done = number_of<int>(text.substr(1, slash - 1));
  const auto total = number_of<int>(text.substr(slash + 1, blank - slash - 1));
  const std::string_view rest = text.substr(blank + 1);
  const auto whole_seconds = number_of<int>(rest.substr(0, rest.find_first_not_of("0123456789")));
  if (!done || !total || !whole_seconds) return false;
  const int second = *whole_seconds;
  const std::string told = joined({"carlo: building ", std::to_string(*done), "/",
                                   std::to_string(*total), time_left(*done, *total, second)});
  if (terminal_) {
    shown_ = true;
    say({"\r\x1b[K", told});
  } else if (second - told_ >= 10) {
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
