#include "grader/judge/watch.h"

#include <sys/stat.h>

#include <algorithm>
#include <set>
#include <string>
#include <system_error>
#include <utility>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 100'000;
constexpr int deepest = 64;

/// Returns the bytes that no folder shows: files that were removed while open, and those that never
/// had a name.
std::size_t nameless_bytes(const Family& family) {
  std::set<std::pair<dev_t, ino_t>> seen;
  std::size_t bytes = 0;
  std::error_code ec;
  for (const ProcessEntry& entry : family) {
    const fs::path descriptors = fs::path("/proc") / std::to_string(entry.id) / "fd";
    for (fs::directory_iterator it(descriptors, ec), end; it != end && !ec; it.increment(ec)) {
      struct stat status {};
      if (::stat(it->path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
      if (status.st_nlink != 0 || !seen.insert({status.st_dev, status.st_ino}).second) continue;
      bytes += static_cast<std::size_t>(status.st_blocks) * 512;
    }
  }
  return bytes;
}

bool any_in(const Family& family, char state) {
  return std::any_of(family.begin(), family.end(),
                     [&](const ProcessEntry& entry) { return entry.state == state; });
}

}  // namespace

bool fuller_than(const fs::path& folder, const Family& family, std::size_t most) {
  constexpr auto skip = fs::directory_options::skip_permission_denied;
  std::size_t bytes = nameless_bytes(family), files = 0;
  if (bytes > most) return true;
  std::error_code ec;
  for (fs::recursive_directory_iterator it(folder, skip, ec), end; it != end && !ec;
       it.increment(ec)) {
    struct stat status {};
    if (::lstat(it->path().c_str(), &status) != 0) continue;
    bytes += static_cast<std::size_t>(status.st_blocks) * 512;
    if (bytes > most || ++files > most_files || it.depth() > deepest) return true;
  }
  return false;
}

bool blocked(const Family& family) {
  return any_in(family, 'D') && !any_in(family, 'R');
}

std::size_t memory_bytes(const Family& family) {
  std::size_t bytes = 0;
  for (const ProcessEntry& entry : family)
    bytes += entry.resident_bytes + page_table_bytes(entry.id);
  return bytes;
}

std::size_t threads_of(const Family& family) {
  std::size_t threads = 0;
  for (const ProcessEntry& entry : family)
    threads += entry.threads;
  return threads;
}

double processor_seconds(const Family& family) {
  double seconds = 0;
  for (const ProcessEntry& entry : family)
    seconds += entry.seconds;
  return seconds;
}

}  // namespace carlo::grader
