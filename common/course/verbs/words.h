#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

// Texts and command lines built from parts. Everybody's first verdict waits for this program to
// compile: one call with all parts compiles in half the time of adding strings.

namespace carlo::verbs {

using Words = std::vector<std::string>;

/// A piece of text, valid for the duration of the call that takes it.
class Part {
 public:
  Part(const char* text) : text_(text) {}
  Part(const std::string& text) : text_(text) {}
  Part(const std::filesystem::path& path) : text_(path.native()) {}
  std::string_view text() const { return text_; }

 private:
  std::string_view text_;
};
using Parts = std::initializer_list<Part>;

/// Concatenate the parts to a text, or make each one a word.
std::string joined(Parts parts);
Words list_of(Parts parts);

Words& operator+=(Words& words, Parts more);
Words& operator+=(Words& words, const Words& more);
std::string joined(const Words& words, const char* between);
Words behind(const Words& words, std::size_t first);  ///< the words from `first` on

/// Prints the parts to stderr.
void say(Parts parts);
/// Throws Error with that message.
[[noreturn]] void fail(Parts parts);

bool is_one_of(const std::string& word, Parts words);
bool is_one_of(const std::string& word, const Words& words);
bool asks_for_help(const std::string& word);
/// True if a word consists of 1 to `most` digits.
bool is_number(const std::string& word, std::size_t most);
int as_number(const std::string& digits);

}  // namespace carlo::verbs
