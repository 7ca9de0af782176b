#pragma once

#include "course/guide/own_files.h"
#include "course/verdict/verdict.h"

#include <filesystem>
#include <map>
#include <string>

namespace carlo {

/// What the judge said last about one exercise, and about which text.
struct KeptVerdict {
  ExerciseResult result;  ///< without figures
  std::string exercise;   ///< OwnCode::digest() of the exercise

  bool passed() const { return result.status == Status::passed; }
};

/// The last verdicts of all exercises, kept in a small JSON file that is made when it is not there.
class VerdictBook {
 public:
  /// Throws Error when the file is there but not such a file.
  explicit VerdictBook(std::filesystem::path file);

  /// The last verdict, or null.
  const KeptVerdict* find(const Exercise& exercise) const;

  /// Takes the verdicts of one run of the judge about `code`. Throws Error when they are of another
  /// lab.
  void take(const LabResult& judged, const Lab& lab, const OwnCode& code);

  /// Throws Error when the file cannot be written.
  void save() const;

 private:
  std::filesystem::path file_;
  std::map<std::string, KeptVerdict> verdicts_;  ///< by "1.2"
};

}  // namespace carlo
