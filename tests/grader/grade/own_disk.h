#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <optional>

namespace carlo::grader {

/// A folder over which lies a file system of its own size, in memory, as long as this object
/// lives: whatever is written there fills no disk of others. Only this process and those that it
/// starts see it; it goes with the last of them, however they end.
class OwnDisk {
 public:
  /// `owner`: whose group may pass through the folder; else it is ours alone. Where the system
  /// allows no such thing (it is for root outside of most containers) the folder stays on its disk.
  OwnDisk(std::filesystem::path folder, std::size_t bytes, std::optional<uid_t> owner);
  ~OwnDisk();
  OwnDisk(const OwnDisk&) = delete;
  OwnDisk& operator=(const OwnDisk&) = delete;

  bool mounted() const { return mounted_; }
  const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
  bool mounted_ = false;
};

/// Closes a folder of ours to all but ourselves and, to pass through it, the user of a sandbox.
/// Throws Error.
void open_to_pass(const std::filesystem::path& folder, std::optional<uid_t> user);

}  // namespace carlo::grader
