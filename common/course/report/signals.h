#pragma once

#include <string>
#include <string_view>

// What a lab's program says when a signal ends it.

namespace carlo {

/// From now on a crash of this program (bad access, integer division by zero, abort, stack
/// overflow) first names on stderr the experiment in which it happened. In a sanitizer build
/// nothing is changed, since sanitizers report more.
void report_crashes();

/// Notes the experiment that begins.
void note_experiment(std::string_view title);

/// Returns the title of the current experiment, cut to about 250 bytes; empty before the first.
/// Safe in a signal handler.
std::string_view noted_experiment();

/// While this exists, Ctrl-C prints on stderr in which experiment the program was stopped, that no
/// results were written, and `advice`, then ends the program as SIGINT does. Only one may exist at
/// a time. If SIGINT is already ignored, it stays so.
class StopNote {
 public:
  explicit StopNote(const std::string& advice);
  ~StopNote();
  StopNote(const StopNote&) = delete;
  StopNote& operator=(const StopNote&) = delete;
};

}  // namespace carlo
