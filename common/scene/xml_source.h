#pragma once

#include "scene/errors.h"

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// Whose scene format a file is in: Mitsuba 0.6's, or that of Mitsuba 2 and 3. Names of both are
/// understood in every file (names.h); this decides where the same words mean different things.
enum class Dialect { mitsuba06, mitsuba3 };

/// The text of one XML file as it stands on disk, kept so that errors can point into it.
struct XmlSource {
  std::filesystem::path path;
  std::filesystem::path main_folder;  ///< of the scene that includes it, or its own
  std::string text;
  Dialect dialect = Dialect::mitsuba06;  ///< by its version, once that was read
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
  bool broken = false;  ///< it has a $parameter that nobody knows
};

struct Plugin;

/// An XML element; `at` is its '<'.
struct XmlElement {
  std::string name;
  Position at;
  /// An error of its own was told (not of what stands inside): it is given, but means nothing.
  bool broken = false;
  const Plugin* plugin = nullptr;  ///< of an object, once grammar.h has found it
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;

  const XmlAttribute* find(std::string_view attribute) const;
  /// Throws Error when the attribute is missing: at the element, or at one that looks as if it had
  /// been meant.
  const XmlAttribute& get(std::string_view attribute) const;
  /// Tells of each attribute that is not among `names`. Whether there was none.
  bool allow_only(const std::vector<std::string_view>& names, SceneErrors& errors) const;
  /// Tells of an element inside. Whether there was none.
  bool allow_nothing_inside(SceneErrors& errors) const;
};

/// Throws PlacedError "FILE:LINE:COLUMN: error: message"; line and column count from 1, a column is
/// a character (UTF-8).
[[noreturn]] void fail_at(Position at, const std::string& message);

template <class... Args>
[[noreturn]] void fail(Position at, fmt::format_string<Args...> format, Args&&... args) {
  fail_at(at, fmt::format(format, std::forward<Args>(args)...));
}

/// Where a file stands that is named at this place: beside the file that names it or, as Mitsuba
/// looks, beside the scene that includes that one.
std::filesystem::path find_file(Position at, const std::filesystem::path& name);

/// Reads a file. Throws Error at `asked_at` (where the file is named), or at line 1 of the file
/// itself when `asked_at` has no source.
std::unique_ptr<XmlSource> read_xml_source(const std::filesystem::path& path, Position asked_at);

/// The root element of a file. Throws Error at what is no XML. Only elements, attributes and
/// comments may stand in it; anything else (text between elements, two roots, doubled attributes,
/// deep nesting) is left out and told of. `source` must outlive the result.
XmlElement parse_xml(const XmlSource& source, SceneErrors& errors);

}  // namespace carlo
