#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carlo::grader {

/// What stands below some folders: for each path its kind, rights, owner, size, and
/// when it was changed last.
class Canary {
 public:
  /// `listed`: folders that others use too, of which only the entries of unknown owners count.
  Canary(std::vector<std::filesystem::path> folders, std::vector<std::filesystem::path> listed);

  /// The paths that have come, gone or changed since then.
  std::vector<std::string> changes() const;

 private:
  using Picture = std::map<std::string, std::string>;
  Picture look() const;

  std::vector<std::filesystem::path> folders_, listed_;
  Picture before_;
};

/// Makes this process the parent of all orphans that a program it starts leaves behind.
void gather_orphans();

/// Ends the processes that were left behind, each by its id, and tells them.
std::vector<std::string> end_those_left();

}  // namespace carlo::grader
