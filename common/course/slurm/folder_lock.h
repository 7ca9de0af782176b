#pragma once

#include "course/cli/descriptor.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace carlo::slurm {

/// A lock on a folder that holds for all machines that share it (flock() of FOLDER/.lock, which NFS
/// since version 4, Lustre with -o flock and other file systems pass on to their server), as long
/// as this object lives; the kernel releases it when the process ends, however it does.
class FolderLock {
 public:
  enum class Use {
    alone,    ///< nobody else may have the lock
    together  ///< others may share it
  };

  /// Returns none if others hold it. Throws Error if the folder cannot be locked at all.
  static std::optional<FolderLock> take(const std::filesystem::path& folder, Use use);

  /// Returns who last held the folder alone, and perhaps still does: "process 12 on node1".
  static std::string holder(const std::filesystem::path& folder);

 private:
  explicit FolderLock(Descriptor file) : file_(std::move(file)) {}

  Descriptor file_;
};

}  // namespace carlo::slurm
