#pragma once

#include "course/exercises.h"

#include <filesystem>
#include <string>

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
  std::string text_;  ///< the file's JSON
};

/// The exercise that a person means by "1.2" or "Lab 1.2". Throws Error that says which there are.
const Exercise& find_exercise(const std::vector<Lab>& labs, const std::string& typed);

/// The next hint, or the last again when all have been seen, with its number and what to do next.
/// Notes it in `state`. Throws Error when the exercise has none.
std::string next_hint(const Exercise& exercise, HintState& state);

/// Hint `step` (from 1) once more. Throws Error when it has not been seen yet or does not exist.
std::string seen_hint(const Exercise& exercise, int step, const HintState& state);

/// All hints that have been seen. Throws Error when none has.
std::string seen_hints(const Exercise& exercise, const HintState& state);

}  // namespace carlo
