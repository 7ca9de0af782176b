#pragma once

#include "grader/calibrate/record.h"

#include <filesystem>
#include <map>
#include <set>

namespace carlo::grader {

/// All judgements so far, one file labNN.jsonl per lab in a folder, one line per judgement. Each
/// line is appended in a single write, so a kill loses only the running judgements; a line that was
/// cut short nevertheless is skipped, and the next one starts on a new line.
class Store {
 public:
  /// Creates the folder if it is missing. Throws Error.
  explicit Store(std::filesystem::path folder);

  bool has(const JobKey& key) const { return records_.count(key) > 0; }
  /// Throws Error if it cannot be written.
  void append(const Record& record);
  /// Returns the records by lab, subject and seed, regardless of the order in which they were made.
  const std::map<JobKey, Record>& records() const { return records_; }
  /// Returns the number of unreadable lines.
  int unreadable() const { return unreadable_; }

 private:
  std::filesystem::path file_of(int lab) const;
  void read(const std::filesystem::path& file);

  std::filesystem::path folder_;
  std::map<JobKey, Record> records_;
  std::set<std::filesystem::path> begun_;  ///< files that this store has appended to
  int unreadable_ = 0;
};

}  // namespace carlo::grader
