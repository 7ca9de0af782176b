#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carlo::grader {

/// The content of some folders: for each path its kind, rights, owner, size, and the time of its
/// last change.
class Canary {
 public:
  /// `listed`: folders that others use too, of which only the entries of unknown owners count.
  Canary(std::vector<std::filesystem::path> folders, std::vector<std::filesystem::path> listed);

  /// Returns the paths that have appeared, disappeared or changed since construction.
  std::vector<std::string> changes() const;

 private:
  using Picture = std::map<std::string, std::string>;
  Picture look() const;

  std::vector<std::filesystem::path> folders_, listed_;
  Picture before_;
};

/// Makes this process the parent of all orphans that a program it starts leaves behind.
void gather_orphans();

/// Ends the processes that were left behind, each by its id, and lists them.
std::vector<std::string> end_those_left();

}  // namespace carlo::grader
