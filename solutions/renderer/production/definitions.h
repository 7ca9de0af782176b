#pragma once

#include <string>
#include <vector>

namespace carlo {

/// Formats the arguments of -D as one setting.
std::string definitions_text(const std::vector<std::string>& definitions);

/// Parses that text again. Throws Error that begins with `place` if it is not such a text.
std::vector<std::string> definitions_of(const std::string& text, const std::string& place);

}  // namespace carlo
