#include "report/html.h"

#include <algorithm>
#include <cctype>

namespace carlo {

namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string script_escaped(std::string_view code) {
  // Inside a JavaScript string or regular expression the backslash changes nothing.
  std::string result(code);
  replace_all(result, "<!--", "<\\!--");
  constexpr std::string_view end_tag = "</script";
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  auto at = result.begin();
  while ((at = std::search(at, result.end(), end_tag.begin(), end_tag.end(), same)) !=
         result.end()) {
    at = result.insert(at + 1, '\\');
  }
  return result;
}

std::string json_for_html(std::string_view json) {
  std::string text;
  for (const char c : json)
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return text;
}

}  // namespace carlo
