#include "grader/judge/crash.h"

#include "grader/protocol/frame.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <sstream>
#include <string_view>
#include <utility>

namespace carlo::grader {
namespace {

constexpr std::string_view address_report = "ERROR: AddressSanitizer: ";
constexpr std::string_view undefined_report = ": runtime error: ";
constexpr std::string_view thrown_type = "terminate called after throwing an instance of '";
constexpr std::string_view thrown_words = "  what():  ";
constexpr std::string_view nothing_thrown = "terminate called without an active exception";

/// Returns the text after `start`, up to `end` or the line's end; empty if `start` is missing.
std::string after(const std::string& said, std::string_view start, std::string_view end) {
  const std::size_t at = said.find(start);
  if (at == std::string::npos) return "";
  const std::string line = said.substr(at + start.size(), said.find('\n', at) - at - start.size());
  return line.substr(0, line.find(end));
}

/// Says why a stack is full, and what to do. `size`: in MB; may be empty.
std::string full_stack(const std::string& size) {
  return fmt::format(
      "the stack is full{}: a recursion goes too deep, or a local array is too large; use a loop, or a "
      "std::vector",
      size.empty() ? "" : fmt::format(" ({} MB)", size));
}

/// Returns the usual name for a signal that AddressSanitizer abbreviates, and for a full stack.
std::string in_words(const std::string& word) {
  constexpr std::array<std::pair<std::string_view, int>, 5> signals{
      {{"SEGV", SIGSEGV}, {"ABRT", SIGABRT}, {"FPE", SIGFPE}, {"ILL", SIGILL}, {"BUS", SIGBUS}}};
  for (const auto& [name, signal] : signals) {
    if (word == name) return signal_name(signal);
  }
  return word == "stack-overflow" ? full_stack("") : word;
}

/// Returns the library's message if std::terminate() ended the program; otherwise empty.
std::string termination(const std::string& said) {
  const std::string type = after(said, thrown_type, "'");
  if (!type.empty()) {
    const std::string words = after(said, thrown_words, "\n");
    return fmt::format(
        "an exception ({}{}{}) left a thread's function, or one that is noexcept, "
        "and std::terminate() ended the program",
        type.substr(0, 100), words.empty() ? "" : ": ", words.substr(0, 100));
  }
  if (said.find(nothing_thrown) == std::string::npos) return "";
  return "std::terminate() ended the program, as it does when a std::thread is destroyed without "
         "join() or detach()";
}

/// Returns whether a line is the library's, before an abort, or the worker's about its stack.
bool is_of_library(const std::string& line) {
  return line.find(": Assertion '") != std::string::npos || line.rfind(thrown_type, 0) == 0 ||
         line.rfind(thrown_words, 0) == 0 || line.rfind(nothing_thrown, 0) == 0 ||
         line.rfind(stack_report, 0) == 0;
}

std::string cause_of(const Outcome& outcome) {
  const std::size_t at = outcome.output.find(": Assertion '");
  const std::size_t size = outcome.output.find("size()' failed", at);
  if (at != std::string::npos && size != std::string::npos && size - at < 60) {
    return "an index outside of its vector, array or span";
  }
  // A student may print this, too: it is a message, and marks do not depend on it.
  const std::string stack = after(outcome.output, stack_report, stack_report_end);
  if (outcome.code == SIGSEGV && !stack.empty()) return full_stack(stack.substr(0, 6));
  std::string terminated = termination(outcome.output);
  if (!terminated.empty()) return terminated;
  const std::string memory = after(outcome.output, address_report, " on ");
  if (!memory.empty()) return in_words(memory.substr(0, 100));
  const std::string undefined = after(outcome.output, undefined_report, "\n");
  if (!undefined.empty()) return undefined.substr(0, 200);
  return signal_name(outcome.code);
}

/// Returns whether `path` is a C++ file in a lab's folder, such as
/// "labs/07_hemisphere/hemisphere.cpp".
bool in_a_lab(std::string_view path) {
  constexpr std::size_t name = 8;  // its start, after "labs/NN_"
  const std::size_t slash = path.find('/', name);
  return slash != std::string_view::npos && slash > name && std::isdigit(path[5]) != 0 &&
         std::isdigit(path[6]) != 0 && path[7] == '_' &&
         path.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", name) == slash &&
         slash + 1 < path.rfind('.') && (path.ends_with(".cpp") || path.ends_with(".h"));
}

}  // namespace

std::string place_in(const std::string& said) {
  constexpr std::string_view digits = "0123456789";
  constexpr std::string_view of_paths =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./";
  for (std::size_t at = said.find("labs/"); at != std::string::npos;
       at = said.find("labs/", at + 1)) {
    const std::string_view rest = std::string_view(said).substr(at);
    const std::size_t colon = std::min(rest.find_first_not_of(of_paths), rest.size());
    const std::string_view path = rest.substr(0, colon);
    const std::size_t end = rest.find_first_not_of(digits, std::min(colon + 1, rest.size()));
    const std::string_view line = rest.substr(std::min(colon + 1, rest.size()), end - colon - 1);
    if (in_a_lab(path) && colon < rest.size() && rest[colon] == ':' && !line.empty()) {
      return std::string(path) + ":" + std::string(line);
    }
  }
  return "";
}

bool has_report(const std::string& said) {
  return said.find(address_report) != std::string::npos ||
         said.find(undefined_report) != std::string::npos;
}

std::string place_in_report(const std::string& said) {
  return has_report(said) ? place_in(said) : "";
}

std::string without_reports(const std::string& said) {
  std::string out;
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);) {
    const bool ruler = line.size() > 20 && line.find_first_not_of('=') == std::string::npos;
    if (ruler || line.find(address_report) != std::string::npos) break;
    if (line.find(undefined_report) != std::string::npos) break;
    if (line.rfind("AddressSanitizer:", 0) == 0) continue;  // for a signal, before the report
    // The last line may have no line end.
    if (!lines.eof()) line += '\n';
    if (!is_of_library(line)) out += line;
  }
  return out;
}

std::string crash_cause(const Outcome& outcome) {
  const std::string place = place_in_report(outcome.output);
  return cause_of(outcome) + (place.empty() ? "" : ", in " + place);
}

}  // namespace carlo::grader
