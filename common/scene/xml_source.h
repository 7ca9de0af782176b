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

/// The scene format of a file: Mitsuba 0.6's, or that of Mitsuba 2 and 3. Every file may use the
/// names of both (names.h); the dialect decides where the same text means different things.
enum class Dialect { mitsuba06, mitsuba3 };

/// The text of one XML file as on disk, kept so that errors can point into it.
struct XmlSource {
  std::filesystem::path path;
  std::filesystem::path main_folder;  ///< of the scene that includes it, or its own
  std::string text;
  Dialect dialect = Dialect::mitsuba06;  ///< according to its version, once that was read
};

/// A position in an XML file, in bytes.
struct Position {
  const XmlSource* source = nullptr;
  std::size_t offset = 0;
};

struct XmlAttribute {
  std::string name;
  std::string value;    ///< with $parameters replaced, once parameters.h has processed it
  std::string written;  ///< as in the file
  Position name_at, value_at;
  bool broken = false;  ///< it has an unknown $parameter
};

struct Plugin;

/// An XML element; `at` is its '<'.
struct XmlElement {
  std::string name;
  Position at;
  /// An error of its own was reported (not one of its contents): it exists, but has no meaning.
  bool broken = false;
  const Plugin* plugin = nullptr;  ///< for an object, once grammar.h has found it
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;

  const XmlAttribute* find(std::string_view attribute) const;
  /// Throws Error when the attribute is missing: at the element, or at an attribute that looks like
  /// a misspelling of it.
  const XmlAttribute& get(std::string_view attribute) const;
  /// Reports each attribute that is not among `names`. Returns true if there was none.
  bool allow_only(const std::vector<std::string_view>& names, SceneErrors& errors) const;
  /// Reports any element inside. Returns true if there was none.
  bool allow_nothing_inside(SceneErrors& errors) const;
};

/// Throws PlacedError "FILE:LINE:COLUMN: error: message"; line and column count from 1, columns in
/// characters (UTF-8).
[[noreturn]] void fail_at(Position at, const std::string& message);

template <class... Args>
[[noreturn]] void fail(Position at, fmt::format_string<Args...> format, Args&&... args) {
  fail_at(at, fmt::format(format, std::forward<Args>(args)...));
}

/// The path of a file that is named at this position: beside the file that names it or, as in
/// Mitsuba, beside the scene that includes that file.
std::filesystem::path find_file(Position at, const std::filesystem::path& name);

/// Reads a file. Throws Error at `asked_at` (where the file is named), or at line 1 of the file
/// itself when `asked_at` has no source.
std::unique_ptr<XmlSource> read_xml_source(const std::filesystem::path& path, Position asked_at);

/// The root element of a file. Throws Error at what is not XML. Only elements, attributes and
/// comments may stand in it; anything else (text between elements, two roots, duplicate attributes,
/// deep nesting) is left out and reported. `source` must outlive the result.
XmlElement parse_xml(const XmlSource& source, SceneErrors& errors);

}  // namespace carlo
