#pragma once

#include "course/guide/exercises.h"
#include "course/guide/hints.h"
#include "course/guide/verdicts.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo {

struct ExerciseStatus {
  const Exercise* exercise = nullptr;
  Stage stage = Stage::untouched;
  double points = 0;     ///< from the last verdict; 0 if a function is open again
  bool changed = false;  ///< what it depends on was edited since the last verdict
  int open = 0;          ///< functions not implemented
  int hints = 0;         ///< hints seen
  std::string message;   ///< what was wrong, in one line
};

struct LabStatus {
  const Lab* lab = nullptr;
  std::vector<ExerciseStatus> exercises;

  double points() const;
  int passed() const;
  int changed() const;  ///< number of passed exercises that were edited since
  bool begun() const;   ///< whether any exercise is no longer untouched
};

/// Returns the status of a lab, from its files below the folder `labs`.
LabStatus status_of(const Lab& lab, const std::filesystem::path& labs, const VerdictBook& book,
                    const HintState& hints);

/// Returns the exercise to do next, the first that has not passed; null if all have.
const Exercise* next_exercise(const LabStatus& lab);
const Exercise* next_exercise(const std::vector<LabStatus>& labs);

/// Formats one exercise as a line without line end; in colour if stdout shows it. `titles` is the
/// width of the column of titles; longer titles are cut.
std::string status_line(const ExerciseStatus& status, std::size_t titles);
/// Formats the lab's name, a bar (on a terminal), its points and how many verdicts are outdated,
/// without line end.
std::string status_heading(const LabStatus& status);
/// The width of a lab's column of titles, in characters: that of the longest title, if the terminal
/// has room.
std::size_t title_width(const LabStatus& lab);

/// Formats for the reader: every lab, the exercises of labs that are begun or next (`all`: of all
/// labs), totals and the next exercise.
std::string status_text(const std::vector<LabStatus>& labs, bool all);
/// The same as JSON.
std::string status_json(const std::vector<LabStatus>& labs);

}  // namespace carlo
