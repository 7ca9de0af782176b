#pragma once

#include "grader/calibrate/record.h"

#include <filesystem>
#include <map>
#include <set>

namespace carlo::grader {

/// All judgements made so far, a file labNN.jsonl a lab in one folder, a line a judgement. A line
/// is appended in one write, so whoever is killed loses the judgements under way and no other; a
/// line that was cut short all the same is passed over, and what follows starts on a new one.
class Store {
 public:
  /// Makes the folder if it is missing. Throws Error.
  explicit Store(std::filesystem::path folder);

  bool has(const JobKey& key) const { return records_.count(key) > 0; }
  /// Throws Error when it cannot be written.
  void append(const Record& record);
  /// In order of lab, subject and seed, whatever the order they were made in.
  const std::map<JobKey, Record>& records() const { return records_; }
  /// Lines that could not be read.
  int unreadable() const { return unreadable_; }

 private:
  std::filesystem::path file_of(int lab) const;
  void read(const std::filesystem::path& file);

  std::filesystem::path folder_;
  std::map<JobKey, Record> records_;
  std::set<std::filesystem::path> begun_;  ///< files that have been appended to by this store
  int unreadable_ = 0;
};

}  // namespace carlo::grader
