#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo::grader {

/// What archives have asked of us so far.
struct ArchiveUse {
  std::size_t entries = 0, bytes = 0;  ///< bytes: unpacked
};

/// What an archive, or all that one submission holds, may ask of us.
struct ArchiveLimits {
  std::size_t entries = 300'000;
  std::size_t entry_bytes = std::size_t{64} << 20;   ///< of one file that is read
  std::size_t total_bytes = std::size_t{512} << 20;  ///< unpacked, read or not
  ArchiveUse* together = nullptr;                    ///< of archives that share these limits
};

/// One file of an archive.
struct ArchiveEntry {
  std::string path;  ///< relative, without . and .., with slashes
  /// Unpacks it into memory. Throws Error when it is too large or spoilt. Only while it is visited.
  std::function<std::string()> read;
};

/// Visits the regular files of a zip or tar archive (also gzip'ed). Nothing is written to the disk.
/// Links, devices and paths that lead out of the archive go to `refused`, with the reason. Throws
/// Error when it is no such archive, or breaks the limits.
void visit_archive(const std::filesystem::path& file, const ArchiveLimits& limits,
                   const std::function<void(const ArchiveEntry&)>& visit,
                   const std::function<void(const std::string& what)>& refused);
/// The same for one part of an archive of many: a file, or all below a folder. The others' are
/// passed over, unread and uncounted: whatever they packed is no matter of this one.
void visit_part(const std::filesystem::path& file, const std::string& part,
                const ArchiveLimits& limits, const std::function<void(const ArchiveEntry&)>& visit,
                const std::function<void(const std::string& what)>& refused);
/// The same for an archive that is in memory.
void visit_archive(std::string_view bytes, const ArchiveLimits& limits,
                   const std::function<void(const ArchiveEntry&)>& visit,
                   const std::function<void(const std::string& what)>& refused);

/// The paths of all regular files of an archive that do not lead out of it. Nothing is unpacked, so
/// that nothing that one of them holds can hide the others. Throws Error when it is no such
/// archive.
std::vector<std::string> archive_paths(const std::filesystem::path& file);

/// Whether a file's name is one of an archive that we read.
bool is_archive_name(const std::string& name);

/// "alice" of "alice.zip" or "alice.tar.gz"; other names as they are.
std::string without_archive_ending(const std::string& name);

}  // namespace carlo::grader
