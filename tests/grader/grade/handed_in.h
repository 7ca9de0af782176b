#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// Returns whether it is a folder itself; not a link, which may lead nowhere or in a circle.
bool is_folder(const std::filesystem::directory_entry& entry);

/// Returns whether a text is UTF-8 without control characters, blanks and direction marks (U+0080
/// to U+009F, U+2000 to U+206F), without the fullwidth forms of =, + and @, which begin a formula
/// in some spreadsheets (U+FF00 to U+FF3F), and without noncharacters (U+FFC0 on).
bool is_harmless_utf8(const std::string& text);

/// Returns a folder name: letters, digits, and . _ - within; at most 100 bytes; not one of `taken`,
/// to which it is added.
std::string folder_name(const std::string& wanted, std::vector<std::string>& taken);

}  // namespace carlo::grader
