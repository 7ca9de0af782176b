#pragma once

#include "course/verdict/verdict.h"

#include <cstddef>
#include <string>

namespace carlo {

/// Makes text from a student's program or compiler harmless, so that it can neither control the
/// terminal nor start a line of the report: control characters, including C1 (in UTF-8: 0xC2 0x80
/// to 0x9F), become spaces.
std::string harmless(std::string text);

/// Cuts a name or text that a stranger chose to about `bytes`; "..." marks an omission. No UTF-8
/// character is split.
std::string clipped(std::string text, std::size_t bytes);

/// Returns the first `most` lines that the program printed in a test, each after `margin` and cut
/// to 80 characters, and how many more there were. Harmless.
std::string printed_lines(const TestRecord& test, std::size_t most, const std::string& margin);

}  // namespace carlo
