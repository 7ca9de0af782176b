#pragma once

#include "course/guide/exercises.h"
#include "course/guide/hints.h"
#include "course/guide/verdicts.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo {

/// How far a student is with an exercise, by the files and the last verdict.
enum class Stage {
  untouched,  ///< all its functions say that they are not implemented
  begun,      ///< some do, or none does but the judge has not seen it
  edited,     ///< edited since it was judged, when points were missing
  failed,     ///< judged, and points are missing
  passed      ///< all points at the last verdict, whatever was edited since
};

struct ExerciseStatus {
  const Exercise* exercise = nullptr;
  Stage stage = Stage::untouched;
  double points = 0;     ///< of the last verdict; none where a function is open again
  bool changed = false;  ///< what it is made of was edited since it was judged
  int open = 0;          ///< functions not implemented
  int hints = 0;         ///< seen
  std::string message;   ///< what was wrong, in one line
};

struct LabStatus {
  const Lab* lab = nullptr;
  std::vector<ExerciseStatus> exercises;

  double points() const;
  int passed() const;
  int changed() const;  ///< of those that passed, how many were edited since
  bool begun() const;   ///< some exercise is no longer untouched
};

/// Of one lab, by its files below the folder `labs`.
LabStatus status_of(const Lab& lab, const std::filesystem::path& labs, const VerdictBook& book,
                    const HintState& hints);

/// What to do next, for everything that says so: the first exercise that has not passed; null when
/// all have.
const Exercise* next_exercise(const LabStatus& lab);
const Exercise* next_exercise(const std::vector<LabStatus>& labs);

/// One line for one exercise, without line end; in colour where stdout shows it. `titles`: how wide
/// the column of titles is. A longer one is cut.
std::string status_line(const ExerciseStatus& status, std::size_t titles);
/// The lab's name, a bar (on a terminal), its points and how many verdicts are of older text,
/// without line end.
std::string status_heading(const LabStatus& status);
/// How wide a lab's column of titles is, in characters: as the widest, if the terminal has the
/// room.
std::size_t title_width(const LabStatus& lab);

/// For people: every lab, the exercises of those that are begun and of the one that is next
/// (`all`: of all), totals and what is next.
std::string status_text(const std::vector<LabStatus>& labs, bool all);
/// For programs.
std::string status_json(const std::vector<LabStatus>& labs);

}  // namespace carlo
