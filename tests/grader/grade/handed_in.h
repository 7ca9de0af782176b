#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// Whether it is a folder itself; not a link, of which some lead nowhere or round in a circle.
bool is_folder(const std::filesystem::directory_entry& entry);

/// Whether a text is UTF-8 without control characters, blanks and marks that change the direction
/// of writing (U+0080 to U+009F, U+2000 to U+206F); and without the wide forms of =, + and @, which
/// begin a formula in some spreadsheets (U+FF00 to U+FF3F), and what is no character (U+FFC0 on).
bool is_harmless_utf8(const std::string& text);

/// A name for a folder: letters, digits, and . _ - within; at most 100 bytes; not one of `taken`,
/// to which it is added.
std::string folder_name(const std::string& wanted, std::vector<std::string>& taken);

}  // namespace carlo::grader
