#include "report/html.h"

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

/// Text from `at` on, one character at a time; behind its end there are zeros.
class Reader {
 public:
  Reader(std::string_view text, std::size_t at) : text_(text), at_(at) {}

  std::size_t place() const { return at_; }
  char next(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  void skip(std::size_t count) { at_ += count; }
  template <class Kind>
  void skip_all(Kind kind) {
    while (kind(next()))
      ++at_;
  }
  /// A number's digits, and those behind a point.
  void skip_number() {
    skip_all(is_digit);
    if (next() != '.' || !is_digit(next(1))) return;
    skip(1);
    skip_all(is_digit);
  }

 private:
  std::string_view text_;
  std::size_t at_;
};

std::string raised(std::string_view exponent) {
  std::string text = html_escaped(exponent);
  replace_all(text, "-", "−");
  return "<sup>" + text + "</sup>";
}

/// The formula at `at` as HTML, and where it ends; nothing when no formula begins there.
struct Formula {
  std::string html;
  std::size_t end = 0;
};

/// What follows a '^': "7", "n", "2.5", "-1/4", "(1/d)".
Formula power(std::string_view text, std::size_t at) {
  const std::size_t close = text.find(')', at);
  if (text.substr(at, 1) == "(" && close != std::string_view::npos) {
    return {raised(text.substr(at + 1, close - at - 1)), close + 1};
  }
  Reader reader(text, at);
  const bool negative = reader.next() == '-';
  if (negative) reader.skip(1);
  if (!is_word(reader.next())) return {};
  is_digit(reader.next()) ? reader.skip_number() : reader.skip_all(is_word);
  if (negative && reader.next() == '/' && is_digit(reader.next(1))) {
    reader.skip(1);
    reader.skip_number();
  }
  return {raised(text.substr(at, reader.place() - at)), reader.place()};
}

/// "1e-10", "2.5e6".
Formula scientific(std::string_view text, std::size_t at) {
  Reader reader(text, at);
  reader.skip_number();
  const std::string factor(text.substr(at, reader.place() - at));
  if (reader.next() != 'e') return {};
  const std::size_t exponent = reader.place() + 1;
  reader.skip(reader.next(1) == '-' || reader.next(1) == '+' ? 2 : 1);
  const std::size_t digits = reader.place();
  reader.skip_all(is_digit);
  if (reader.place() == digits || is_word(reader.next())) return {};
  const bool plus = text[exponent] == '+';
  return {(factor == "1" ? "" : factor + "·") + "10" +
              raised(text.substr(exponent + plus, reader.place() - exponent - plus)),
          reader.place()};
}

Formula formula(std::string_view text, std::size_t at) {
  const char c = text[at], before = at == 0 ? ' ' : text[at - 1];
  const Reader behind(text, at + 1);
  if (c == '^' && before != ' ') return power(text, at + 1);
  if (is_digit(c) && !is_word(before) && before != '.') return scientific(text, at);
  const bool number = is_digit(behind.next()) || (behind.next() == '.' && is_digit(behind.next(1)));
  if (c == '-' && number && (before == ' ' || before == '(')) return {"−", at + 1};
  return {};
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
