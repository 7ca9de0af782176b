#pragma once

#include "course/guide/exercises.h"
#include "course/verdict/verdict_text.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carlo {

/// Hints are given one step at a time; which have been seen is kept in a small JSON file
/// ({"hints": {"1.2": 1}}), made when it is not there.
class HintState {
 public:
  /// Throws Error when the file is there but not such a file.
  explicit HintState(std::filesystem::path file);

  int seen(const Exercise& exercise) const;
  /// Notes that `count` hints have been seen and saves. Throws Error when that fails.
  void set_seen(const Exercise& exercise, int count);

 private:
  std::filesystem::path file_;
  std::map<std::string, int> seen_;  ///< by "1.2"
};

/// The exercise that a person means by "1.2" or "Lab 1.2". Throws Error that says which there are.
const Exercise& find_exercise(const std::vector<Lab>& labs, const std::string& typed);

/// A hint as it is shown.
struct Hint {
  const Exercise* exercise = nullptr;
  int step = 1;   ///< from 1
  int count = 1;  ///< how many the exercise has
  /// What it says of those behind it.
  enum class More { unsaid, another, none_left, was_the_last } more = More::unsaid;
};

/// The next hint, or the last again when all have been seen. Notes it in `state`. Throws Error when
/// the exercise has none.
Hint next_hint(const Exercise& exercise, HintState& state);

/// Hint `step` (from 1) once more. Throws Error when it has not been seen yet or does not exist.
Hint seen_hint(const Exercise& exercise, int step, const HintState& state);

/// All hints that have been seen. Throws Error when none has.
std::vector<Hint> seen_hints(const Exercise& exercise, const HintState& state);

/// For people: the exercise, the hint's number, how to come to the next, the hint.
std::string hint_text(const Hint& hint, Help help = Help::typed);
/// Of several hints of one exercise, which is named once. There is at least one.
std::string hint_text(const std::vector<Hint>& hints);

}  // namespace carlo
