#pragma once

#include <string_view>

namespace carlo {

/// Returns `text` without a leading UTF-8 byte order mark (bytes EF BB BF), which some editors
/// write. Source: The Unicode Standard, 23.8, "Byte Order Mark (BOM)".
constexpr std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  if (text.starts_with(mark)) text.remove_prefix(mark.size());
  return text;
}

/// Returns whether the text begins with a UTF-16 (or little-endian UTF-32) byte order mark, so that
/// its bytes are not characters.
constexpr bool is_utf16(std::string_view text) {
  return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
}

}  // namespace carlo
