#pragma once

#include <string_view>

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

}  // namespace carlo
