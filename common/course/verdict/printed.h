#pragma once

#include "course/verdict/verdict.h"

#include <cstddef>
#include <string>

namespace carlo {

/// What a student's program says, or a compiler of it, must not steer the terminal nor start a line
/// of the report: control characters, the C1 ones (in UTF-8: 0xC2 0x80 to 0x9F) among them, become
/// spaces.
std::string harmless(std::string text);

/// A name or text that a stranger chose, in at most some `bytes`; "..." where something is left
/// out. No letter of UTF-8 is cut.
std::string clipped(std::string text, std::size_t bytes);

/// The first `most` lines that the program printed in a test, each behind `margin` and cut to 80
/// characters, and how many there were besides. Harmless.
std::string printed_lines(const TestRecord& test, std::size_t most, const std::string& margin);

}  // namespace carlo
