#pragma once

#include <string_view>

namespace carlo {

/// Returns `text` without a leading UTF-8 byte order mark (bytes EF BB BF), which some editors
/// write.
std::string_view without_byte_order_mark(std::string_view text);

/// Returns whether the text begins with a UTF-16 (or little-endian UTF-32) byte order mark, so that
/// its bytes are not characters.
bool is_utf16(std::string_view text);

}  // namespace carlo
