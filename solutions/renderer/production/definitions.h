#pragma once

#include <string>
#include <vector>

namespace carlo {

/// What was given by -D, as one setting.
std::string definitions_text(const std::vector<std::string>& definitions);

/// The list again. Throws Error that begins with `place` if the text is none.
std::vector<std::string> definitions_of(const std::string& text, const std::string& place);

}  // namespace carlo
