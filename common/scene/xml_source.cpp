#include "scene/xml_source.h"

#include "scene/text.h"
#include "support/atomic_file.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace carlo {
namespace {

namespace fs = std::filesystem;

/// A place where a file's tags do not match, and the message about it.
struct TagFault {
  std::size_t offset;  ///< of the tag's '<'
  std::string message;
};

struct Tag {
  std::string_view name;
  std::size_t offset = 0;
  bool closing = false;  ///< </name>
  bool whole = false;    ///< <name/>: opened and closed at once
};

/// Iterates over the tags of a text; skips comments and the like.
class Tags {
 public:
  explicit Tags(std::string_view text) : text_(text) {}

  /// The next tag; empty at the end, also if the file is cut off inside a tag.
  std::optional<Tag> next() {
    while ((at_ = text_.find('<', at_)) != std::string_view::npos) {
      if (starts("<!--")) {
        skip("-->");
      } else if (starts("<![CDATA[")) {
        skip("]]>");
      } else if (starts("<?")) {
        skip("?>");
      } else if (starts("<!")) {
        skip(">");
      } else {
        return tag();
      }
    }
    return {};
  }

 private:
  bool starts(std::string_view with) const { return text_.substr(at_, with.size()) == with; }

  void skip(std::string_view end) {
    const std::size_t found = text_.find(end, at_);
    at_ = found == std::string_view::npos ? text_.size() : found + end.size();
  }

  std::optional<Tag> tag() {
    Tag tag;
    tag.offset = at_++;
    tag.closing = at_ < text_.size() && text_[at_] == '/';
    if (tag.closing) ++at_;
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n/>", at_), text_.size());
    tag.name = text_.substr(at_, end - at_);
    at_ = end;
    char quote = 0;  // a '>' in quotes does not end a tag
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (quote != 0) {
        if (c == quote) quote = 0;
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '>') {
        tag.whole = text_[at_ - 1] == '/';
        return tag;
      }
    }
    return {};
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

auto line_of(std::string_view text, std::size_t offset) {
  return 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset),
                        end_of_line(text));
}

/// A tag's name for a message; in files that are not XML it may have any length.
std::string shown(const Tag& tag) {
  const std::string quoted = in_quotes(tag.name);
  return quoted.substr(1, quoted.size() - 2);
}

/// The first element that is never closed, or the first closing tag that closes nothing, in a text
/// that an XML parser has refused; nothing if all tags match.
std::optional<TagFault> tag_fault(std::string_view text) {
  std::vector<Tag> open;
  Tags tags(text);
  while (const auto tag = tags.next()) {
    if (tag->whole) continue;
    if (!tag->closing) {
      open.push_back(*tag);
      continue;
    }
    if (!open.empty() && open.back().name == tag->name) {
      open.pop_back();
      continue;
    }
    const auto same = [&](const Tag& other) { return other.name == tag->name; };
    if (std::any_of(open.begin(), open.end(), same)) {
      return TagFault{open.back().offset,
                      fmt::format("<{}> is not closed before </{}> in line {}", shown(open.back()),
                                  shown(*tag), line_of(text, tag->offset))};
    }
    return TagFault{tag->offset,
                    open.empty()
                        ? fmt::format("</{}> closes nothing: no element is open", shown(*tag))
                        : fmt::format("</{}> closes nothing: open is <{}>, in line {}", shown(*tag),
                                      shown(open.back()), line_of(text, open.back().offset))};
  }
  if (open.empty()) return {};
  return TagFault{open.back().offset, fmt::format("<{}> is never closed", shown(open.back()))};
}

constexpr int deepest_nesting = 16;

bool starts_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
}

// Converts pugixml's tree, which lives in `buffer`, into ours. Its strings are stored in place, so
// their addresses give their positions in the file.
class Converter {
 public:
  Converter(const XmlSource& source, const std::string& buffer, SceneErrors& errors)
      : source_(source), buffer_(buffer), errors_(errors) {}

  XmlElement element(const pugi::xml_node& node, int depth) const {
    XmlElement out;
    out.name = node.name();
    out.at = before(node.name());
    for (const pugi::xml_attribute& a : node.attributes()) {
      if (out.find(a.name()) != nullptr) {
        errors_.guard(
            [&] { fail(at(a.name()), "attribute {} is given twice", in_quotes(a.name())); });
      } else {
        out.attributes.push_back(
            {a.name(), a.value(), a.value(), at(a.name()), at(a.value()), false});
      }
    }
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() != pugi::node_element) {
        reject_text(child, out);
      } else if (depth == deepest_nesting) {
        fail(before(child.name()), "elements are nested more than {} deep", deepest_nesting);
      } else {
        out.children.push_back(element(child, depth + 1));
      }
    }
    return out;
  }

 private:
  /// Text here is most likely an element whose '<' is missing.
  void reject_text(const pugi::xml_node& text, XmlElement& around) const {
    around.broken = true;
    errors_.lose_names();
    errors_.guard([&] {
      fail(text.value()[0] != '\0' ? at(text.value()) : around.at,
           "unexpected text inside <{}>: {}", around.name, in_quotes(text.value()));
    });
  }

  Position at(const char* text) const {
    const std::less<> less;
    const char* const begin = buffer_.data();
    if (less(text, begin) || !less(text, begin + buffer_.size())) return {&source_, 0};
    return {&source_, static_cast<std::size_t>(text - begin)};
  }

  Position before(const char* name) const {
    Position position = at(name);
    if (position.offset > 0) --position.offset;
    return position;
  }

  const XmlSource& source_;
  const std::string& buffer_;
  SceneErrors& errors_;
};

void check_encoding(const XmlSource& source) {
  const std::size_t nul = source.text.find('\0');
  if (nul != std::string::npos) {
    fail({&source, nul}, "not an XML file in UTF-8: it contains a zero byte");
  }
}

[[noreturn]] void fail_parse(const XmlSource& source, const pugi::xml_parse_result& result) {
  const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0));
  if (result.status == pugi::status_end_element_mismatch) {
    if (const auto fault = tag_fault(source.text)) {
      fail({&source, fault->offset}, "not well-formed XML: {}", fault->message);
    }
  }
  const bool at_end = source.text.find_first_not_of(" \t\r\n", offset) == std::string::npos;
  fail({&source, offset}, "not well-formed XML: {}",
       at_end ? "the file ends inside a tag" : result.description());
}

}  // namespace

const XmlAttribute* XmlElement::find(std::string_view attribute) const {
  const auto same = [&](const XmlAttribute& a) { return a.name == attribute; };
  const auto found = std::find_if(attributes.begin(), attributes.end(), same);
  return found == attributes.end() ? nullptr : &*found;
}

const XmlAttribute& XmlElement::get(std::string_view attribute) const {
  const XmlAttribute* found = find(attribute);
  if (found != nullptr) return *found;
  for (const XmlAttribute& a : attributes) {
    if (!is_near(a.name, attribute)) continue;
    fail(a.name_at, "<{}> has no attribute {} (did you mean {}?)", name, in_quotes(a.name),
         in_quotes(attribute));
  }
  fail(at, "<{}> needs the attribute {}", name, in_quotes(attribute));
}

bool XmlElement::allow_only(const std::vector<std::string_view>& names, SceneErrors& errors) const {
  const std::size_t before = errors.count();
  for (const XmlAttribute& a : attributes) {
    if (std::find(names.begin(), names.end(), a.name) != names.end()) continue;
    errors.guard([&] {
      fail(a.name_at, "<{}> has no attribute {}{}", name, in_quotes(a.name),
           suggest(a.name, {names.begin(), names.end()}));
    });
  }
  return errors.count() == before;
}

bool XmlElement::allow_nothing_inside(SceneErrors& errors) const {
  return children.empty() ||
         errors.guard([&] { fail(children.front().at, "<{}> takes no elements inside", name); });
}

void fail_at(Position at, const std::string& message) {
  const std::string_view text =
      std::string_view(at.source->text).substr(0, std::min(at.offset, at.source->text.size()));
  const char end = end_of_line(at.source->text);
  const auto line = static_cast<std::size_t>(1 + std::count(text.begin(), text.end(), end));
  const std::size_t newline = text.rfind(end);
  const std::string_view last = newline == std::string_view::npos ? text : text.substr(newline + 1);
  const auto column =
      static_cast<std::size_t>(1 + std::count_if(last.begin(), last.end(), starts_character));
  throw PlacedError(at.source->path.string(), line, column, message);
}

fs::path find_file(Position at, const fs::path& name) {
  const fs::path here = at.source->path.parent_path() / name;
  const fs::path beside_main = at.source->main_folder / name;
  std::error_code ec;
  return !fs::exists(here, ec) && fs::exists(beside_main, ec) ? beside_main : here;
}

std::unique_ptr<XmlSource> read_xml_source(const fs::path& path, Position asked_at) {
  auto source = std::make_unique<XmlSource>();
  source->path = path;
  source->main_folder =
      asked_at.source != nullptr ? asked_at.source->main_folder : path.parent_path();
  const Position blame = asked_at.source != nullptr ? asked_at : Position{source.get(), 0};
  std::error_code ec;
  const fs::file_status status = fs::status(path, ec);
  if (!fs::exists(status)) fail(blame, "{} does not exist", path_in_quotes(path));
  if (fs::is_directory(status)) {
    fail(blame, "{} is a folder, expected a scene file", path_in_quotes(path));
  }
  if (!fs::is_regular_file(status)) fail(blame, "{} is not a file", path_in_quotes(path));
  try {
    source->text = read_file(path);
  } catch (const Error&) {
    fail(blame, "{} cannot be read", path_in_quotes(path));
  }
  return source;
}

XmlElement parse_xml(const XmlSource& source, SceneErrors& errors) {
  check_encoding(source);
  std::string buffer = source.text;
  pugi::xml_document document;
  const unsigned flags = pugi::parse_default | pugi::parse_declaration;
  const pugi::xml_parse_result result =
      document.load_buffer_inplace(buffer.data(), buffer.size(), flags, pugi::encoding_utf8);
  if (result.status == pugi::status_no_document_element) {
    fail({&source, 0}, "no XML element found, expected <scene>");
  }
  if (!result) {
    fail_parse(source, result);
  }
  const std::string_view encoding = document.first_child().type() == pugi::node_declaration
                                        ? document.first_child().attribute("encoding").value()
                                        : "";
  if (!encoding.empty() && encoding != "utf-8" && encoding != "UTF-8" && encoding != "us-ascii") {
    fail({&source, 0}, "encoding {} is not supported, expected utf-8", in_quotes(encoding));
  }
  XmlElement root = Converter(source, buffer, errors).element(document.document_element(), 1);
  for (pugi::xml_node next = document.document_element().next_sibling(); next;
       next = next.next_sibling()) {
    if (next.type() == pugi::node_element) {
      const auto offset = static_cast<std::size_t>(next.name() - buffer.data()) - 1;
      errors.guard([&] {
        fail({&source, offset}, "a second root element <{}>, expected one", next.name());
      });
    }
  }
  return root;
}

}  // namespace carlo
