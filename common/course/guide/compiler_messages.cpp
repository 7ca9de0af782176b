#include "course/guide/compiler_messages.h"

#include "course/cli/wrap.h"
#include "course/guide/own_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

namespace carlo {
namespace {

namespace fs = std::filesystem;
using Whose = CompilerMessage::Whose;

/// "FILE:LINE:COLUMN: rest" or "FILE:LINE: rest".
struct Located {
  std::string file;
  std::size_t line = 0, column = 0;
  std::string rest;
};

/// Removes a number and the colon behind it from the front and returns it; 0 if they are not there.
std::size_t strip_number(std::string_view& text) {
  std::size_t number = 0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), number);
  const auto digits = static_cast<std::size_t>(end - text.data());
  if (ec != std::errc() || digits >= text.size() || text[digits] != ':') return 0;
  text.remove_prefix(digits + 1);
  return number;
}

std::optional<Located> located(std::string_view line) {
  Located place;
  const std::size_t colon = line.find(':', 1);
  if (colon == std::string_view::npos || line.front() == ' ') return std::nullopt;
  place.file = line.substr(0, colon);
  std::string_view rest = line.substr(colon + 1);
  place.line = strip_number(rest);
  if (place.line == 0) return std::nullopt;
  place.column = strip_number(rest);
  while (!rest.empty() && rest.front() == ' ')
    rest.remove_prefix(1);
  place.rest = rest;
  return place;
}

/// Removes `word` from the front; returns false if it is not there.
bool strip_prefix(std::string& text, std::string_view word) {
  if (text.rfind(word, 0) != 0) return false;
  text.erase(0, word.size());
  return true;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// Removes every "LEAD...>" with all between the brackets: template arguments that nobody wrote.
void drop_argument(std::string& text, std::string_view lead) {
  for (std::size_t at = 0; (at = text.find(lead, at)) != std::string::npos;) {
    int depth = 1;
    std::size_t end = at + lead.size();
    for (; end < text.size() && depth > 0; ++end)
      depth += text[end] == '<' ? 1 : text[end] == '>' ? -1 : 0;
    if (depth > 0) return;
    text.erase(at, end - at);
  }
}

/// Removes the noise of the library's templates and cuts the text to a few lines.
std::string calm(std::string text) {
  replace_all(text, "std::__cxx11::", "std::");
  replace_all(text, "std::basic_string<char>", "std::string");
  replace_all(text, "std::basic_string_view<char>", "std::string_view");
  replace_all(text, "long unsigned int", "unsigned long");
  replace_all(text, "long int", "long");
  for (const std::string_view lead :
       {", std::allocator<", ", std::char_traits<", ", std::less<", ", std::default_delete<"})
    drop_argument(text, lead);
  replace_all(text, " >", ">");
  constexpr std::size_t most = 400;
  const std::size_t with = text.find(" [with ");
  if (text.size() > 160 && with != std::string::npos) text.erase(with);
  if (text.size() > most) {
    std::size_t end = most;
    while ((text[end] & 0xC0) == 0x80)
      --end;  // not inside a character
    text = text.substr(0, end) + " ...";
  }
  return text;
}

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

/// Recognises GCC's two phrases and Clang's for a missing return. Such a function returns garbage,
/// so this warning comes before all others.
bool lacks_return(const std::string& text) {
  return has(text, "no return statement in function") ||
         has(text, "control reaches end of non-void") ||
         has(text, "non-void function does not return");
}

/// Recognises the errors that an unclosed function causes: everything below it counts as inside it.
bool stands_inside(const std::string& text) {
  return has(text, "function-definition is not allowed here") ||
         has(text, "function definition is not allowed here") ||
         has(text, "qualified-id in declaration before");
}

/// A missing } causes an error for each function below it: keeps only the first and explains it.
void explain_missing_brace(std::vector<CompilerMessage>& messages) {
  const auto first = std::find_if(messages.begin(), messages.end(), [](const CompilerMessage& m) {
    return m.whose == Whose::own && stands_inside(m.text);
  });
  if (first == messages.end()) return;
  const std::string file = first->file;
  const auto is_end = [&](const CompilerMessage& m) {
    return m.file == file && (has(m.text, "at end of input") || m.text == "expected '}'");
  };
  if (std::none_of(messages.begin(), messages.end(), is_end)) return;
  first->text = "this function begins inside the one above it, where a } is missing";
  const std::size_t line = first->line;
  const auto follows = [&](const CompilerMessage& m) {
    return m.file == file && m.line > line &&
           (is_end(m) || stands_inside(m.text) || has(m.text, "expected identifier before"));
  };
  messages.erase(std::remove_if(messages.begin(), messages.end(), follows), messages.end());
}

/// "   12 |   code" or "      |   ^~~~", or Clang's lines without numbers.
bool is_excerpt(const std::string& line) {
  const std::size_t first = line.find_first_not_of(' ');
  if (first == 0 || first == std::string::npos) return false;
  const std::size_t bar = line.find_first_not_of("0123456789 ");
  return bar != std::string::npos && (line[bar] == '|' || line[bar] == '^' || line[bar] == '~');
}

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// `text` from its first word on: skips the quotes, which depend on the compiler's language and
/// take one byte or several.
std::string_view from_word(std::string_view text) {
  return {std::find_if(text.begin(), text.end(), is_word), text.end()};
}

std::string_view first_word(std::string_view text) {
  return {text.begin(), std::find_if_not(text.begin(), text.end(), is_word)};
}

/// The name that is reported missing from namespace std, else "": ‘NAME’ is not a member of ‘std’
/// by GCC, no member named 'NAME' in namespace 'std' by Clang.
std::string_view missing_in_std(std::string_view text) {
  constexpr std::string_view clang = "no member named ";
  const bool by_clang = text.starts_with(clang);
  text = from_word(by_clang ? text.substr(clang.size()) : text);
  const std::string_view name = first_word(text);
  const std::string_view phrase = by_clang ? " in namespace " : " is not a member of ";
  const std::size_t at = text.find(phrase);
  if (at == std::string_view::npos || from_word(text.substr(name.size())).data() < text.data() + at)
    return "";
  text = from_word(text.substr(at + phrase.size()));
  if (first_word(text) != "std" || text.size() == 3 || text[3] == ':') return "";
  return name;
}

/// Turns the complaint about an unknown function of <cmath> into advice to include it: every lab
/// needs these functions, and no header of a lab includes them.
std::string with_missing_header(const std::string& text) {
  constexpr std::array<std::string_view, 26> of_cmath = {
      "sqrt",   "cbrt",  "exp",  "expm1", "log",      "log1p",    "pow",   "sin",  "cos",
      "tan",    "asin",  "acos", "atan",  "atan2",    "fabs",     "floor", "ceil", "round",
      "lround", "hypot", "fma",  "isnan", "isfinite", "copysign", "ldexp", "frexp"};
  const std::string_view name = missing_in_std(text);
  if (std::find(of_cmath.begin(), of_cmath.end(), name) == of_cmath.end()) return text;
  return fmt::format("std::{} is not known here: #include <cmath>", name);
}

/// The name that `line` puts between ` or ' and '.
std::string quoted(const std::string& line, std::size_t from) {
  const std::size_t open = line.find_first_of("`'", from);
  if (open == std::string::npos) return line.substr(from);
  const std::size_t close = line.find('\'', open + 1);
  return line.substr(open + 1, close == std::string::npos ? close : close - open - 1);
}

/// Says what to do about a name that the linker does not find.
std::string missing(const std::string& name) {
  // The library's parallel algorithms compile wherever TBB's headers are; nothing here links TBB.
  if (name.rfind("tbb::", 0) == 0)
    return "std::execution::par needs the library TBB, which is not linked: leave it out";
  return fmt::format(
      "{} is called but never defined: is it written with exactly the header's parameters, and in "
      "the header's namespace?",
      calm(name));
}

class Reader {
 public:
  explicit Reader(const fs::path& root) : root_(root.lexically_normal()) {}

  std::vector<CompilerMessage> read(std::string_view log) {
    std::istringstream lines{std::string(log)};
    for (std::string line; std::getline(lines, line);) {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      take_line(without_escapes(line));
    }
    explain_missing_brace(messages_);
    const auto rank = [](const CompilerMessage& m) {
      const int kind = m.error ? 0 : lacks_return(m.text) ? 10 : 20;
      return kind + static_cast<int>(m.whose);
    };
    std::stable_sort(
        messages_.begin(), messages_.end(),
        [&](const CompilerMessage& a, const CompilerMessage& b) { return rank(a) < rank(b); });
    return std::move(messages_);
  }

 private:
  std::string relative(const std::string& file) const {
    const fs::path path = fs::path(file).lexically_normal();
    // ccache may have made it relative to the build folder.
    if (*path.begin() == "..") {
      fs::path rest;
      for (const fs::path& part : path) {
        if (part != "..") rest /= part;
      }
      return rest.string();
    }
    const fs::path inside = path.lexically_relative(root_);
    const bool in_tree = path.is_absolute() && !inside.empty() && *inside.begin() != "..";
    return in_tree ? inside.string() : path.string();
  }

  void take_line(const std::string& line) {
    if (line.empty() || linker(line)) return;
    if (is_excerpt(line)) {
      // A note's excerpt is dropped: only the complaint's own line counts.
      if (wants_excerpt_ && messages_.back().excerpt.size() < 2)
        messages_.back().excerpt.push_back(line);
      return;
    }
    wants_excerpt_ = false;
    std::optional<Located> place = located(line);
    if (!place) {
      // "In file included from FILE:LINE:" and "FILE: In function ..." report no error themselves.
      if (line.rfind("In file included from", 0) == 0) led_here_.clear();
      return;
    }
    place->file = relative(place->file);
    const bool error =
        strip_prefix(place->rest, "error: ") || strip_prefix(place->rest, "fatal error: ");
    if (error || strip_prefix(place->rest, "warning: ")) {
      complaint(*place, error);
    } else if (strip_prefix(place->rest, "note: ")) {
      // Clang names the line that led to the complaint below it.
      if (!messages_.empty() && place->rest.find("requested here") != std::string::npos)
        blame(messages_.back(), *place);
    } else {
      led_here_.push_back(*place);  // GCC names it above: "required from here"
    }
  }

  void complaint(const Located& place, bool error) {
    CompilerMessage message;
    message.error = error;
    message.file = place.file;
    message.line = place.line;
    message.column = place.column;
    message.text = with_missing_header(calm(place.rest));
    if (is_own_file(place.file)) message.whose = Whose::own;
    for (const Located& leading : led_here_)
      blame(message, leading);
    led_here_.clear();
    add(std::move(message));
    wants_excerpt_ = !duplicate_;
  }

  /// Moves a complaint about our files or the library's to the student's line that caused it.
  static void blame(CompilerMessage& message, const Located& place) {
    if (message.whose != Whose::elsewhere || !is_own_file(place.file)) return;
    message.found_in = fmt::format("{}:{}", message.file, message.line);
    message.whose = Whose::caused;
    message.file = place.file;
    message.line = place.line;
    message.column = place.column;
    message.excerpt.clear();
  }

  bool linker(const std::string& line) {
    for (const std::string_view what : {"undefined reference to ", "undefined symbol: "}) {
      const std::size_t at = line.find(what);
      if (at == std::string::npos) continue;
      const std::string name =
          what.back() == ' ' && what[10] == 's' ? line.substr(at + what.size()) : quoted(line, at);
      link_error(missing(name));
      return true;
    }
    const std::size_t at = line.find("multiple definition of ");
    if (at == std::string::npos) return false;
    link_error(fmt::format("{} is defined twice", calm(quoted(line, at))));
    return true;
  }

  void link_error(std::string text) {
    CompilerMessage message;
    message.text = std::move(text);
    message.whose = Whose::caused;
    add(std::move(message));
  }

  /// Each complaint counts once, although the same file is compiled for the lab and for the judge.
  void add(CompilerMessage message) {
    duplicate_ = !said_
                      .insert(fmt::format("{}:{}:{}:{}", message.file, message.line, message.column,
                                          message.text))
                      .second;
    if (!duplicate_) messages_.push_back(std::move(message));
  }

  fs::path root_;
  std::vector<CompilerMessage> messages_;
  std::vector<Located> led_here_;
  std::set<std::string> said_;
  bool wants_excerpt_ = false, duplicate_ = false;
};

}  // namespace

std::vector<CompilerMessage> compiler_messages(std::string_view log, const fs::path& root) {
  return Reader(root).read(log);
}

}  // namespace carlo
