#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace carlo {

/// A place where a file's tags do not match, and the message about it.
struct TagFault {
  std::size_t offset;  ///< of the tag's '<'
  std::string message;
};

/// The first element that is never closed, or the first closing tag that closes nothing, in a text
/// that an XML parser has refused; nothing if all tags match.
std::optional<TagFault> tag_fault(std::string_view text);

}  // namespace carlo
