#include "grader/judge/watch.h"

#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <system_error>
#include <vector>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 100'000;
constexpr std::size_t most_processes = 10'000;

/// Adds the children of a process, whichever of its threads has started them.
void add_children(pid_t parent, std::vector<pid_t>& list) {
  std::error_code ec;
  for (fs::directory_iterator it(fmt::format("/proc/{}/task", parent), ec), end; it != end && !ec;
       it.increment(ec)) {
    std::ifstream children(it->path() / "children");
    for (pid_t child = 0; children >> child;)
      list.push_back(child);
  }
}

std::size_t unshared_bytes(pid_t process) {
  std::ifstream file(fmt::format("/proc/{}/statm", process));
  std::size_t size = 0, resident = 0, shared = 0;
  if (!(file >> size >> resident >> shared) || resident < shared) return 0;
  return (resident - shared) * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

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
    if (bytes > most || ++files > most_files) return true;
  }
  return false;
}

std::size_t descendants_bytes(pid_t ancestor) {
  std::vector<pid_t> list;
  add_children(ancestor, list);
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < list.size() && i < most_processes; ++i) {
    bytes += unshared_bytes(list[i]);
    add_children(list[i], list);
  }
  return bytes;
}

}  // namespace carlo::grader
