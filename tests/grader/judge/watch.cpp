#include "grader/judge/watch.h"

#include "grader/judge/process_list.h"

#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 100'000;
constexpr int deepest = 64;

std::set<pid_t> family_of(pid_t ancestor, const std::vector<ProcessEntry>& all) {
  std::set<pid_t> family{ancestor};
  // A child's number may be lower than its parent's, so once through the list is not enough.
  for (std::size_t before = 0; before != family.size();) {
    before = family.size();
    for (const ProcessEntry& entry : all) {
      if (family.count(entry.parent) != 0) family.insert(entry.id);
    }
  }
  family.erase(ancestor);
  return family;
}

/// What no folder shows: files that were removed while they were open, and those that never had a
/// name.
std::size_t nameless_bytes(pid_t ancestor) {
  std::set<std::pair<dev_t, ino_t>> seen;
  std::size_t bytes = 0;
  std::error_code ec;
  for (const pid_t id : family_of(ancestor, list_processes())) {
    const fs::path descriptors = fs::path("/proc") / std::to_string(id) / "fd";
    for (fs::directory_iterator it(descriptors, ec), end; it != end && !ec; it.increment(ec)) {
      struct stat status {};
      if (::stat(it->path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
      if (status.st_nlink != 0 || !seen.insert({status.st_dev, status.st_ino}).second) continue;
      bytes += static_cast<std::size_t>(status.st_blocks) * 512;
    }
  }
  return bytes;
}

}  // namespace

bool fuller_than(const fs::path& folder, pid_t ancestor, std::size_t most) {
  constexpr auto skip = fs::directory_options::skip_permission_denied;
  std::size_t bytes = nameless_bytes(ancestor), files = 0;
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

double longest_wait(pid_t ancestor) {
  double longest = 0;
  std::error_code ec;
  for (const pid_t id : family_of(ancestor, list_processes())) {
    const fs::path threads = fs::path("/proc") / std::to_string(id) / "task";
    for (fs::directory_iterator it(threads, ec), end; it != end && !ec; it.increment(ec)) {
      // Nanoseconds on a processor, and nanoseconds of waiting for one.
      std::ifstream file(it->path() / "schedstat");
      double ran = 0, waited = 0;
      if (file >> ran >> waited) longest = std::max(longest, waited * 1e-9);
    }
  }
  return longest;
}

std::size_t descendants_bytes(pid_t ancestor) {
  const std::vector<ProcessEntry> all = list_processes();
  const std::set<pid_t> family = family_of(ancestor, all);
  std::size_t bytes = 0;
  for (const ProcessEntry& entry : all) {
    if (family.count(entry.id) != 0) bytes += entry.resident_bytes;
  }
  return bytes;
}

double descendants_seconds(pid_t ancestor) {
  const std::vector<ProcessEntry> all = list_processes();
  const std::set<pid_t> family = family_of(ancestor, all);
  double seconds = 0;
  for (const ProcessEntry& entry : all) {
    if (family.count(entry.id) != 0) seconds += entry.seconds;
  }
  return seconds;
}

}  // namespace carlo::grader
