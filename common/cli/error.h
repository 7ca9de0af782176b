#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace carlo {

/// Something the user can mend: a bad argument, a bad file, a full disk. what() is one line that
/// says what was found and what was expected; main() prints it to stderr and exits with 1.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}

  template <class... Args>
  explicit Error(fmt::format_string<Args...> format, Args&&... args)
      : std::runtime_error(fmt::format(format, std::forward<Args>(args)...)) {}
};

/// At a place in a file: what() is "FILE:LINE:COLUMN: error: message", as compilers have it.
class PlacedError : public Error {
 public:
  PlacedError(const std::string& file, std::size_t line, std::size_t column,
              const std::string& message)
      : Error("{}:{}:{}: error: {}", file, line, column, message) {}
};

}  // namespace carlo
