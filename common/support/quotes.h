#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace carlo {

/// `text` in double quotes for a one-line message: control characters and bytes that are no UTF-8
/// escaped, long text cut.
std::string in_quotes(std::string_view text);

/// The same for a path: a long one keeps its end, which names the file.
std::string path_in_quotes(const std::filesystem::path& path);

/// `word` as it is typed in a shell: in single quotes if it needs them.
std::string shell_word(std::string_view word);

}  // namespace carlo
