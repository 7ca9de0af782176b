#include "grader/grade/foreign_symbols.h"

#include <cxxabi.h>
#include <fmt/core.h>

#include <cctype>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <sstream>

namespace carlo::grader {

namespace {

/// Each back reference in a name (S_, S1_, T_) may double what is printed, so that a name of 400
/// letters may expand to 2^40: students can choose such names. Names that people write have a few.
bool is_short_when_read(const std::string& symbol) {
  constexpr std::size_t longest = 1000, most_references = 12;
  if (symbol.size() > longest) return false;
  std::size_t references = 0;
  for (std::size_t i = 0; i + 1 < symbol.size(); ++i) {
    const auto next = static_cast<unsigned char>(symbol[i + 1]);
    const bool refers = next == '_' || std::isdigit(next) != 0 || std::isupper(next) != 0;
    if ((symbol[i] == 'S' || symbol[i] == 'T') && refers) ++references;
  }
  return references <= most_references;
}

std::string cut(const std::string& name) {
  constexpr std::size_t shown = 200;
  return name.size() <= shown ? name : name.substr(0, shown) + "...";
}

}  // namespace

std::string readable(const std::string& symbol) {
  if (!is_short_when_read(symbol)) return cut(symbol);
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(
      abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status), std::free);
  return cut(name ? name.get() : symbol);
}

namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Weak and unique symbols: those of templates and inline functions in headers.
bool is_from_headers(const std::string& letters) {
  return letters.find_first_not_of("wWvVu") == std::string::npos;
}

/// operator new and delete, and names that are not C++: an object can replace these even if we do
/// not define them.
bool is_replaceable(const std::string& symbol) {
  return !symbol.starts_with("_Z") || symbol.starts_with("_Zn") || symbol.starts_with("_Zd");
}

/// By exclusion: nm has letters other than T and D for definitions in unusual sections.
bool is_defined(const std::string& letters) {
  return letters.find_first_not_of("Uwv") != std::string::npos;
}

/// Returns whether defining it would replace something of ours. `contract`: it is in the lab's own
/// namespace, in which we define what is given, and use what is asked for.
bool replaces(const std::string& symbol, const std::string& letters, const Symbols& ours,
              bool contract) {
  const auto found = ours.find(symbol);
  if (found == ours.end()) return false;
  if (is_defined_once(found->second)) return true;
  if (is_from_headers(letters)) return is_replaceable(symbol) && !is_from_headers(found->second);
  return !contract || is_defined(found->second);
}

}  // namespace

bool is_defined_once(const std::string& letters) {
  return letters.find_first_not_of("UwWvVu") != std::string::npos;
}

void add_symbols(Symbols& symbols, const std::string& nm_output) {
  std::istringstream lines(nm_output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, letter;
    if (!(words >> name >> letter) || letter.size() != 1) continue;
    // For the linker write@@VERSION defines write.
    if (const auto version = name.find('@'); version != 0) name = name.substr(0, version);
    std::string& letters = symbols[name];
    if (!has(letters, letter)) letters += letter;
  }
}

std::string foreign_symbols(const Symbols& exercise, const Symbols& ours, const std::string& lab) {
  const std::string part = fmt::format("{}{}", lab.size(), lab);
  const std::string tests = fmt::format("{}{}_tests", lab.size() + 6, lab);
  for (const auto& [symbol, letters] : exercise) {
    if (has(symbol, tests) || has(symbol, "5carlo6grader")) {
      return fmt::format("it uses {}, which is a part of the grader", readable(symbol));
    }
    const bool contract = symbol.starts_with("_ZN" + part) || symbol.starts_with("_ZNK" + part);
    if (!is_defined(letters) || !replaces(symbol, letters, ours, contract)) continue;
    return fmt::format(
        "it defines {}, which the library or the system defines too: choose another name, or put "
        "it into the namespace {}",
        readable(symbol), lab);
  }
  return "";
}

}  // namespace carlo::grader
