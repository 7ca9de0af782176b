#pragma once

#include "cli/error.h"

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// The text of one XML file as it stands on disk, kept so that errors can point into it.
struct XmlSource {
  std::filesystem::path path;
  std::string text;
};

/// A byte of an XML file.
struct Position {
  const XmlSource* source = nullptr;
  std::size_t offset = 0;
};

struct XmlAttribute {
  std::string name;
  std::string value;    ///< with $parameters replaced, once parameters.h has seen it
  std::string written;  ///< as it stands in the file
  Position name_at, value_at;
};

/// An XML element; `at` is its '<'.
struct XmlElement {
  std::string name;
  Position at;
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;

  const XmlAttribute* find(std::string_view attribute) const;
  /// Throws Error at the element when the attribute is missing.
  const XmlAttribute& get(std::string_view attribute) const;
  /// Throws Error at the first attribute that is not among `names`.
  void allow_only(const std::vector<std::string_view>& names) const;
};

/// Throws PlacedError "FILE:LINE:COLUMN: error: message"; line and column count from 1, a column is
/// a character (UTF-8).
[[noreturn]] void fail_at(Position at, const std::string& message);

template <class... Args>
[[noreturn]] void fail(Position at, fmt::format_string<Args...> format, Args&&... args) {
  fail_at(at, fmt::format(format, std::forward<Args>(args)...));
}

/// Reads a file. Throws Error at `asked_at` (where the file is named), or at line 1 of the file
/// itself when `asked_at` has no source.
std::unique_ptr<XmlSource> read_xml_source(const std::filesystem::path& path, Position asked_at);

/// The root element of a file. Only elements, attributes and comments may stand in it; anything
/// else (text between elements, two roots, doubled attributes, deep nesting) throws Error. `source`
/// must outlive the result.
XmlElement parse_xml(const XmlSource& source);

}  // namespace carlo
