#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <optional>

namespace carlo::grader {

/// A folder covered by an in-memory file system of its own size while this object lives: writing
/// there fills no shared disk. Only this process and those that it starts see it; it disappears
/// with the last of them, however they end.
class OwnDisk {
 public:
  /// `owner`: whose group may pass through the folder; otherwise only we may. If the system does
  /// not allow mounting (it takes root, outside most containers) the folder stays on its disk.
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

/// Closes a folder of ours to all but us and, to pass through it, the user of a sandbox. Throws
/// Error.
void open_to_pass(const std::filesystem::path& folder, std::optional<uid_t> user);

}  // namespace carlo::grader
