#pragma once

#include "course/own_files.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace carlo {

/// What the judge said last about one exercise, and about which text.
struct KeptVerdict {
  double points = 0;
  std::string status;    ///< the judge's: passed, failed, crashed, timeout, not_implemented
  std::string message;   ///< what is wrong, in one line; empty when it passed
  std::string text;      ///< the same in full
  std::string exercise;  ///< OwnCode::digest() of the exercise
};

/// The last verdicts of all exercises, kept in a small JSON file that is made when it is not there.
class VerdictBook {
 public:
  /// Throws Error when the file is there but not such a file.
  explicit VerdictBook(std::filesystem::path file);

  /// The last verdict, or null.
  const KeptVerdict* find(const Exercise& exercise) const;

  /// Takes the verdicts of one run of the judge (the text of its --json) about `code`. Throws Error
  /// when that is no such text or of another lab.
  void take(const std::string& judged, const Lab& lab, const OwnCode& code);

  /// Throws Error when the file cannot be written.
  void save() const;

 private:
  std::filesystem::path file_;
  std::map<std::string, KeptVerdict> verdicts_;  ///< by "1.2"
};

}  // namespace carlo
