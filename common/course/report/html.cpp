#include "course/report/html.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace carlo {

namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

/// Returns the character at `at`; zero past the text's end.
char at_place(std::string_view text, std::size_t at) {
  return at < text.size() ? text[at] : '\0';
}

/// Returns where the number at `at` ends, decimals included.
std::size_t number_end(std::string_view text, std::size_t at) {
  while (is_digit(at_place(text, at)) ||
         (at_place(text, at) == '.' && is_digit(at_place(text, at + 1))))
    ++at;
  return at;
}

std::string raised(std::string_view exponent) {
  std::string text = html_escaped(exponent);
  replace_all(text, "-", "−");
  return "<sup>" + text + "</sup>";
}

/// The formula at a place as HTML, and where it ends; 0 if none begins there.
struct Formula {
  std::string html;
  std::size_t end = 0;
};

/// Parses what follows a '^': "7", "n", "2.5", "-1/4", "(1/d)".
Formula power(std::string_view text, std::size_t at) {
  const std::size_t close = text.find(')', at);
  if (at_place(text, at) == '(' && close != std::string_view::npos) {
    return {raised(text.substr(at + 1, close - at - 1)), close + 1};
  }
  const std::size_t start = at_place(text, at) == '-' ? at + 1 : at;
  std::size_t end = number_end(text, start);
  if (end == start) {
    while (is_word(at_place(text, end)))
      ++end;
  }
  if (end == start) return {};
  // Only after a sign: 1/2^3/4 is ambiguous.
  const bool fraction =
      start > at && at_place(text, end) == '/' && is_digit(at_place(text, end + 1));
  if (fraction) end = number_end(text, end + 1);
  return {raised(text.substr(at, end - at)), end};
}

/// Parses "1e-10", "2.5e6".
Formula scientific(std::string_view text, std::size_t at) {
  const std::size_t e = number_end(text, at);
  if (at_place(text, e) != 'e') return {};
  const bool sign = at_place(text, e + 1) == '-';
  const std::size_t end = number_end(text, e + 1 + sign);
  if (end == e + 1 + sign || is_word(at_place(text, end))) return {};
  const std::string factor(text.substr(at, e - at));
  return {(factor == "1" ? "" : factor + "·") + "10" + raised(text.substr(e + 1, end - e - 1)),
          end};
}

Formula formula(std::string_view text, std::size_t at) {
  const char c = text[at], before = at == 0 ? ' ' : text[at - 1];
  if (c == '^' && before != ' ') return power(text, at + 1);
  if (is_digit(c) && !is_word(before) && before != '.') return scientific(text, at);
  const bool minus =
      c == '-' && (before == ' ' || before == '(') && number_end(text, at + 1) > at + 1;
  return minus ? Formula{"−", at + 1} : Formula{};
}

}  // namespace

std::string html_typeset(std::string_view text) {
  std::string html;
  std::size_t plain = 0;
  for (std::size_t at = 0; at < text.size();) {
    const Formula found = formula(text, at);
    if (found.end == 0) {
      ++at;
      continue;
    }
    html += html_escaped(text.substr(plain, at - plain)) + found.html;
    at = plain = found.end;
  }
  return html + html_escaped(text.substr(plain));
}

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
  // In a JavaScript string or regular expression the backslash changes nothing.
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
