#pragma once

#include <string_view>

namespace carlo {

/// `text` without the mark of UTF-8 that editors put before it (bytes EF BB BF), if it has one.
std::string_view without_byte_order_mark(std::string_view text);

/// Whether it begins with the mark of UTF-16 (or, little-endian, of UTF-32), so that its characters
/// are not bytes.
bool is_utf16(std::string_view text);

}  // namespace carlo
