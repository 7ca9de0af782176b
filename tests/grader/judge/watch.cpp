#include "grader/judge/watch.h"

#include "grader/judge/process_list.h"

#include <sys/stat.h>

#include <set>
#include <system_error>
#include <vector>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 100'000;
constexpr int deepest = 64;

}  // namespace

bool fuller_than(const fs::path& folder, std::size_t most) {
  constexpr auto skip = fs::directory_options::skip_permission_denied;
  std::size_t bytes = 0, files = 0;
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

std::size_t descendants_bytes(pid_t ancestor) {
  const std::vector<ProcessEntry> all = list_processes();
  std::set<pid_t> family{ancestor};
  // A child's number may be lower than its parent's, so once through the list is not enough.
  for (std::size_t before = 0; before != family.size();) {
    before = family.size();
    for (const ProcessEntry& entry : all) {
      if (family.count(entry.parent) != 0) family.insert(entry.id);
    }
  }
  std::size_t bytes = 0;
  for (const ProcessEntry& entry : all) {
    if (entry.id != ancestor && family.count(entry.id) != 0) bytes += entry.resident_bytes;
  }
  return bytes;
}

}  // namespace carlo::grader
