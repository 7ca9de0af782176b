#include "grader/grade/blame.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <sstream>

namespace carlo::grader {
namespace {

constexpr std::array of_the_machine{"No space left on device",
                                    "Disk quota exceeded",
                                    "Input/output error",
                                    "Read-only file system",
                                    "Resource temporarily unavailable",
                                    "Too many open files",
                                    "vfork",
                                    "fork:",
                                    "cannot execute",
                                    "CreateProcess",
                                    "[Bus error]",
                                    "Bus error signal",
                                    "[Terminated]",
                                    "Terminated signal"};

constexpr std::array of_memory{"out of memory",
                               "Out of memory",
                               "emory exhausted",
                               "bad_alloc",
                               "Cannot allocate memory",
                               "Killed signal",
                               "[Killed]",
                               "internal compiler error: Killed"};

template <class Words>
bool has_any(const std::string& line, const Words& words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return line.find(word) != std::string::npos; });
}

/// Returns whether the line is "a.cpp:3:1: error: ...", or quotes a file.
bool is_quote(const std::string& line) {
  if (line.empty() || line.front() == ' ') return true;
  for (std::size_t at = line.find(':'); at != std::string::npos; at = line.find(':', at + 1)) {
    std::size_t end = at + 1;
    while (end < line.size() && std::isdigit(static_cast<unsigned char>(line[end])) != 0)
      ++end;
    if (end > at + 1 && end < line.size() && line[end] == ':') return true;
  }
  return false;
}

/// Returns 9 for "out of memory allocating 9 bytes after a total of 3 bytes"; 0 for other lines.
std::size_t bytes_asked(const std::string& line) {
  const std::string before = "allocating ";
  const auto at = line.find(before);
  std::size_t bytes = 0;
  if (at == std::string::npos) return 0;
  std::from_chars(line.data() + at + before.size(), line.data() + line.size(), bytes);
  return bytes;
}

}  // namespace

bool tells_of_the_machine(const std::string& said, std::size_t peak_bytes,
                          std::size_t memory_limit) {
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);) {
    if (is_quote(line)) continue;
    if (has_any(line, of_the_machine)) return true;
    const bool own = peak_bytes > memory_limit / 2 || bytes_asked(line) > memory_limit / 4;
    if (has_any(line, of_memory) && !own) return true;
  }
  return false;
}

}  // namespace carlo::grader
