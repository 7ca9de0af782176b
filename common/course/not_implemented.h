#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace carlo {

/// Thrown by an exercise that has not been done yet. Graders and lab executables tell it apart from
/// a failure: the exercise is named and left out, the others still run.
class NotImplemented : public std::logic_error {
 public:
  explicit NotImplemented(const std::string& message, std::string function = {})
      : std::logic_error(message), function_(std::move(function)) {}

  /// The name of the function that is to be written, without its class; may be empty.
  const std::string& function() const { return function_; }

 private:
  std::string function_;
};

/// The body of every exercise until it is done. `tag` is the exercise's ("Lab 1.2"), `lecture` the
/// heading of the lecture's section; `function` is the caller. Throws NotImplemented, always.
[[noreturn]] inline void not_implemented(std::string_view tag, std::string_view lecture,
                                         const char* function = __builtin_FUNCTION()) {
  const std::string_view number = tag.substr(tag.find_last_of(' ') + 1);
  std::string message(tag);
  message.append(" is not implemented yet: run ./carlo hint ").append(number);
  message.append(" (lecture: ").append(lecture).append(")");
  throw NotImplemented(message, function);
}

}  // namespace carlo
