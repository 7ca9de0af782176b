#pragma once

#include "course/guide/exercises.h"
#include "course/verdict/verdict_text.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carlo {

/// Gives hints one at a time and remembers how many have been seen in a small JSON file ({"hints":
/// {"1.2": 1}}), created if it does not exist.
class HintState {
 public:
  /// Throws Error if the file exists but is not such a file.
  explicit HintState(std::filesystem::path file);

  int seen(const Exercise& exercise) const;
  /// Saves that `count` hints have been seen. Throws Error if that fails.
  void set_seen(const Exercise& exercise, int count);

 private:
  std::filesystem::path file_;
  std::map<std::string, int> seen_;  ///< by "1.2"
};

/// Finds the exercise for "1.2" or "Lab 1.2". Throws Error that lists the available exercises.
const Exercise& find_exercise(const std::vector<Lab>& labs, const std::string& typed);

/// A hint as it is shown.
struct Hint {
  const Exercise* exercise = nullptr;
  int number = 1;  ///< from 1
  int count = 1;   ///< of the exercise's hints
  /// The text's last line about further hints.
  enum class More { unsaid, another, none_left, was_the_last } more = More::unsaid;
};

/// Returns the next hint, or the last again if all have been seen, and saves it in `state`. Throws
/// Error if the exercise has none.
Hint next_hint(const Exercise& exercise, HintState& state);

/// Returns hint `number` (from 1) again. Throws Error if it has not been seen yet or does not
/// exist.
Hint seen_hint(const Exercise& exercise, int number, const HintState& state);

/// Returns all hints that have been seen. Throws Error if none has.
std::vector<Hint> seen_hints(const Exercise& exercise, const HintState& state);

/// Formats for the reader: the exercise, the hint's number, how to get the next one, the hint.
std::string hint_text(const Hint& hint, Help help = Help::typed);
/// Formats several hints (at least one) of one exercise, which is named once.
std::string hint_text(const std::vector<Hint>& hints);

}  // namespace carlo
