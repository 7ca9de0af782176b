#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

// Texts and command lines put together from parts. Everybody's first verdict waits until this
// program is compiled: a call for all parts is compiled in half of the time that their sums take.

namespace carlo::verbs {

using Words = std::vector<std::string>;

/// A piece of text that lives as long as the call that it is for.
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

/// The parts one behind the other, and as words.
std::string joined(Parts parts);
Words list_of(Parts parts);

Words& operator+=(Words& words, Parts more);
Words& operator+=(Words& words, const Words& more);
std::string joined(const Words& words, const char* between);
Words behind(const Words& words, std::size_t first);  ///< from words[first] on

/// Prints to stderr.
void say(Parts parts);
/// Throws Error with that message.
[[noreturn]] void fail(Parts parts);

bool is_one_of(const std::string& word, Parts words);
bool is_one_of(const std::string& word, const Words& words);
bool asks_for_help(const std::string& word);
bool starts_with(const std::string& word, const char* start);
/// Whether a word has digits alone, from 1 to `most` of them.
bool is_number(const std::string& word, std::size_t most);
int as_number(const std::string& digits);

}  // namespace carlo::verbs
