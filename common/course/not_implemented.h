#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace carlo {

/// Thrown by an exercise that has not been done yet. Graders and lab executables distinguish it
/// from a failure: they name and skip the exercise and run the others.
class NotImplemented : public std::logic_error {
 public:
  /// `tag` is the exercise's ("Lab 1.2"), `lecture` the heading of the lecture's section;
  /// `function` is the function to write, without its class, or empty.
  NotImplemented(std::string tag, std::string_view lecture, std::string function = {})
      : std::logic_error(in_words(tag, lecture)),
        tag_(std::move(tag)),
        function_(std::move(function)) {}

  const std::string& tag() const { return tag_; }
  const std::string& function() const { return function_; }

 private:
  static std::string in_words(std::string_view tag, std::string_view lecture) {
    const std::string_view number = tag.substr(tag.find_last_of(' ') + 1);
    std::string words(tag);
    words.append(" is not implemented yet: run ./carlo hint ").append(number);
    return words.append(" (lecture: ").append(lecture).append(")");
  }

  std::string tag_, function_;
};

/// The body of every exercise until it is done; `function` is the caller. Always throws
/// NotImplemented.
[[noreturn]] inline void not_implemented(std::string_view tag, std::string_view lecture,
                                         const char* function = __builtin_FUNCTION()) {
  throw NotImplemented(std::string(tag), lecture, function);
}

}  // namespace carlo
