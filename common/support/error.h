#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace carlo {

/// An error that the user can fix: a bad argument, a bad file, a full disk. what() is one line that
/// says what was found and what was expected; main() prints it to stderr and exits with 1.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}

  template <class... Args>
  explicit Error(fmt::format_string<Args...> format, Args&&... args)
      : std::runtime_error(fmt::format(format, std::forward<Args>(args)...)) {}
};

/// An Error at a place in a file: what() is "FILE:LINE:COLUMN: error: message", as compilers write
/// it; several errors thrown as one have a line each.
class PlacedError : public Error {
 public:
  PlacedError(std::string file, std::size_t line, std::size_t column, const std::string& message)
      : Error("{}:{}:{}: error: {}", file, line, column, message),
        file_(std::move(file)),
        line_(line),
        column_(column),
        message_(message) {}

  const std::string& file() const { return file_; }
  std::size_t line() const { return line_; }
  std::size_t column() const { return column_; }
  const std::string& message() const { return message_; }  ///< without the place

 private:
  std::string file_;
  std::size_t line_, column_;
  std::string message_;
};

}  // namespace carlo
