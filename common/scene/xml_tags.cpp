#include "scene/xml_tags.h"

#include "scene/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace carlo {
namespace {

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

}  // namespace

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

}  // namespace carlo
