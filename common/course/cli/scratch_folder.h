#pragma once

#include <filesystem>

namespace carlo {

/// Removes everything in a folder that we have permission to remove, including entries deeper than
/// any path can name and folders whose owner has closed them. Does not follow links. Nothing else
/// may modify the folder meanwhile.
void remove_below(int folder);

/// A new folder that nobody else can read, among the temporary files or in another folder; removed
/// with this object.
class ScratchFolder {
 public:
  /// Throws Error if it cannot be created.
  ScratchFolder();
  explicit ScratchFolder(const std::filesystem::path& folder);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace carlo
