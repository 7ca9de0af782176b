#pragma once

#include <string_view>

namespace carlo {

/// From now on a crash of this program (a bad access, a division of whole numbers by zero, an
/// abort, a stack that is used up) first says on stderr in which experiment it happened. Where the
/// program is built with sanitizers they tell more, and nothing is changed.
void tell_crashes();

/// The experiment that begins.
void note_experiment(std::string_view title);

/// The title of the experiment under way, cut to some 250 bytes; empty before the first. A signal
/// handler may ask.
std::string_view noted_experiment();

}  // namespace carlo
