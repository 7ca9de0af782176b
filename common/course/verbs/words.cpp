#include "course/verbs/words.h"

#include "support/error.h"
#include "support/number.h"

#include <cstdio>
#include <cstdlib>

namespace carlo::verbs {

std::string joined(Parts parts) {
  std::string text;
  for (const Part& part : parts)
    text += part.text();
  return text;
}

Words list_of(Parts parts) {
  Words words;
  return words += parts;
}

Words& operator+=(Words& words, Parts more) {
  for (const Part& part : more)
    words.emplace_back(part.text());
  return words;
}

Words& operator+=(Words& words, const Words& more) {
  for (const std::string& word : more)
    words.push_back(word);
  return words;
}

std::string joined(const Words& words, const char* between) {
  std::string text;
  for (const std::string& word : words) {
    if (&word != words.data()) text += between;
    text += word;
  }
  return text;
}

Words behind(const Words& words, std::size_t first) {
  Words rest;
  for (std::size_t i = first; i < words.size(); ++i)
    rest.push_back(words[i]);
  return rest;
}

void say(Parts parts) {
  const std::string text = joined(parts);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

void fail(Parts parts) {
  throw Error(joined(parts));
}

bool is_one_of(const std::string& word, Parts words) {
  for (const Part& part : words)
    if (part.text() == word) return true;
  return false;
}

bool is_one_of(const std::string& word, const Words& words) {
  for (const std::string& one : words)
    if (one == word) return true;
  return false;
}

bool asks_for_help(const std::string& word) {
  return is_one_of(word, {"--help", "-h"});
}

bool is_number(const std::string& word, std::size_t most) {
  return !word.empty() && word.size() <= most &&
         word.find_first_not_of("0123456789") == std::string::npos;
}

int as_number(const std::string& digits) {
  return number_of<int>(digits).value_or(0);
}

}  // namespace carlo::verbs
