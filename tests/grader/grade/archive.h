#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo::grader {

/// The resources that archives have used so far.
struct ArchiveUse {
  std::size_t entries = 0, bytes = 0;  ///< bytes: unpacked
};

/// Limits for an archive, or for everything in one submission.
struct ArchiveLimits {
  std::size_t entries = 300'000;
  std::size_t entry_bytes = std::size_t{64} << 20;   ///< of one file that is read
  std::size_t total_bytes = std::size_t{512} << 20;  ///< unpacked, read or not
  ArchiveUse* together = nullptr;                    ///< shared by archives with common limits
};

/// One file of an archive.
struct ArchiveEntry {
  std::string path;  ///< relative, without . and .., with slashes
  /// Unpacks it into memory. Throws Error if it is too large or corrupt. Only valid during the
  /// visit.
  std::function<std::string()> read;
};

/// Visits the regular files of a zip or tar archive (also gzip'ed). Nothing is written to the disk.
/// Links, devices and paths that lead out of the archive go to `refused`, with the reason. Throws
/// Error if it is no such archive, or exceeds the limits.
void visit_archive(const std::filesystem::path& file, const ArchiveLimits& limits,
                   const std::function<void(const ArchiveEntry&)>& visit,
                   const std::function<void(const std::string& what)>& refused);
/// The same for one part of an archive of many: a file, or all below a folder. Others' parts are
/// skipped, unread and uncounted: their content does not affect this one.
void visit_part(const std::filesystem::path& file, const std::string& part,
                const ArchiveLimits& limits, const std::function<void(const ArchiveEntry&)>& visit,
                const std::function<void(const std::string& what)>& refused);
/// The same for an archive in memory.
void visit_archive(std::string_view bytes, const ArchiveLimits& limits,
                   const std::function<void(const ArchiveEntry&)>& visit,
                   const std::function<void(const std::string& what)>& refused);

/// Returns the paths of all regular files of an archive that do not lead out of it. Unpacks
/// nothing, so that no file's content can hide the others. Throws Error if it is no such archive.
std::vector<std::string> archive_paths(const std::filesystem::path& file);

/// Returns whether a file name is that of an archive we read.
bool is_archive_name(const std::string& name);

/// Returns "alice" for "alice.zip" or "alice.tar.gz"; other names unchanged.
std::string without_archive_ending(const std::string& name);

}  // namespace carlo::grader
