#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace carlo {

/// Whether the system tells of every change to files of this folder: not where other machines, the
/// host of a container or a layer below may change them (NFS, SMB, 9p, FUSE, virtiofs, overlay
/// ...), nor where that cannot be found out, nor on macOS.
bool tells_of_changes(const std::filesystem::path& folder);

/// Tells when source files in some folders may have changed: by inotify, or by looking at their
/// times and sizes where that is not enough.
class FileEvents {
 public:
  /// `look`: never use inotify.
  FileEvents(std::vector<std::filesystem::path> folders, bool look);
  ~FileEvents();
  FileEvents(const FileEvents&) = delete;
  FileEvents& operator=(const FileEvents&) = delete;

  /// Readable when something may have changed; -1 when happened() is to be asked every interval().
  int fd() const { return fd_; }
  bool looks() const { return fd_ < 0; }
  static constexpr int interval_ms = 400;

  /// Whether something may have changed since the last call.
  bool happened();

 private:
  /// Asks the system to tell; fd_ stays -1 where it does not.
  void subscribe();
  /// Whether it has told something since the last call.
  bool told() const;
  /// Names, sizes and times of the source files.
  std::string appearance() const;

  std::vector<std::filesystem::path> folders_;
  int fd_ = -1;
  std::string seen_;
};

}  // namespace carlo
