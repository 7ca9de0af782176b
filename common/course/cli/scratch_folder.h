#pragma once

#include <filesystem>

namespace carlo {

/// Removes all that is in a folder, as far as we may: also what lies deeper than any path can name,
/// and in folders whose owner has closed them. Links are not followed. Nobody else may be at work
/// there.
void remove_below(int folder);

/// A new folder that nobody else can look into, among the temporary files or in another folder; it
/// goes with this object.
class ScratchFolder {
 public:
  /// Throws Error when it cannot be made.
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
