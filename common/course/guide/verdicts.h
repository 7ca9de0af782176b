#pragma once

#include "course/guide/own_files.h"
#include "course/verdict/verdict.h"

#include <filesystem>
#include <map>
#include <string>

namespace carlo {

/// The judge's last verdict on an exercise, and the code it was about.
struct KeptVerdict {
  ExerciseResult result;  ///< without figures
  std::string exercise;   ///< OwnCode::digest() of the exercise when it was judged

  bool passed() const { return result.status == Status::passed; }
};

/// A student's progress on an exercise, from the files and the last verdict.
enum class Stage {
  untouched,  ///< all its functions report "not implemented"
  begun,      ///< some still do, or none does but it has not been judged
  edited,     ///< edited after a verdict with points missing
  failed,     ///< judged, and points are missing
  passed      ///< full points at the last verdict, even if edited since
};

/// `verdict`: the last one, or null.
Stage stage_of(const Exercise& exercise, const OwnCode& code, const KeptVerdict* verdict);

/// The last verdicts of all exercises, kept in a small JSON file, created if it does not exist.
class VerdictBook {
 public:
  /// Throws Error if the file exists but is not such a file.
  explicit VerdictBook(std::filesystem::path file);

  /// Returns the last verdict, or null.
  const KeptVerdict* find(const Exercise& exercise) const;

  /// Takes over the verdicts of one run of the judge on `code`. Throws Error if they are of another
  /// lab.
  void take(const LabResult& judged, const Lab& lab, const OwnCode& code);

  /// Throws Error when the file cannot be written.
  void save() const;

 private:
  std::filesystem::path file_;
  std::map<std::string, KeptVerdict> verdicts_;  ///< by "1.2"
};

}  // namespace carlo
