#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace carlo {

/// Thrown by an exercise that has not been done yet. Graders and lab executables tell it apart from
/// a failure: the exercise is named and left out, the others still run.
class NotImplemented : public std::logic_error {
 public:
  explicit NotImplemented(const std::string& message) : std::logic_error(message) {}
};

/// The body of every exercise until it is done. `tag` is the exercise's ("Lab 1.2"), `lecture` the
/// heading of the lecture's section. Throws NotImplemented, always.
[[noreturn]] inline void not_implemented(std::string_view tag, std::string_view lecture) {
  const std::string_view number = tag.substr(tag.find_last_of(' ') + 1);
  std::string message(tag);
  message.append(" is not implemented yet: run ./carlo hint ").append(number);
  message.append(" (lecture: ").append(lecture).append(")");
  throw NotImplemented(message);
}

}  // namespace carlo
