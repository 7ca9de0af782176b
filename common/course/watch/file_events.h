#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace carlo {

/// Returns whether the system reports every change to files of this folder: not where other
/// machines, a container's host or a lower layer may change them (NFS, SMB, 9p, FUSE, virtiofs,
/// overlay ...), nor where that cannot be determined, nor on macOS.
bool tells_of_changes(const std::filesystem::path& folder);

/// Reports when source files in some folders may have changed: by inotify, or by comparing times
/// and sizes where that is not reliable.
class FileEvents {
 public:
  /// `look`: never use inotify.
  FileEvents(std::vector<std::filesystem::path> folders, bool look);
  ~FileEvents();
  FileEvents(const FileEvents&) = delete;
  FileEvents& operator=(const FileEvents&) = delete;

  /// Readable when something may have changed; -1 if happened() must be polled every interval().
  int fd() const { return fd_; }
  bool polls() const { return fd_ < 0; }
  static constexpr int interval_ms = 400;

  /// Returns whether something may have changed since the last call.
  bool happened();

 private:
  /// Subscribes to the system's notifications; fd_ stays -1 if there are none.
  void subscribe();
  /// Returns whether the system has reported a change since the last call.
  bool has_notification() const;
  /// Returns names, sizes and times of the source files.
  std::string appearance() const;

  std::vector<std::filesystem::path> folders_;
  int fd_ = -1;
  std::string seen_;
};

}  // namespace carlo
