#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace carlo {

/// A file that appears complete or not at all: write to path(), then commit() renames it into
/// place. Without commit() the temporary file is removed, and an existing file of that name is left
/// alone.
class AtomicFile {
 public:
  /// Throws Error if the folder does not exist or is not writable.
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// The temporary file next to the target, with the same extension.
  const std::filesystem::path& path() const { return temporary_; }

  /// Throws Error if the rename fails.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

/// Writes `text` to `target` atomically. Throws Error.
void write_file(const std::filesystem::path& target, std::string_view text);

/// Returns the content of a file. Throws Error naming the path.
std::string read_file(const std::filesystem::path& path);

}  // namespace carlo
