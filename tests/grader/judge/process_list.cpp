#include "grader/judge/process_list.h"

#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <system_error>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

/// From /proc/PID/stat. The name in the second field may hold anything, so the fields are counted
/// from its last parenthesis: the parent's id is the 4th, the resident pages are the 24th.
ProcessEntry entry_of(pid_t id, const fs::path& folder) {
  ProcessEntry entry{id, 0, 0};
  std::ifstream file(folder / "stat");
  std::string line;
  std::getline(file, line);
  const auto name_end = line.rfind(')');
  if (name_end == std::string::npos) return entry;
  std::istringstream fields(line.substr(name_end + 1));
  std::string field;
  for (int number = 3; number <= 24 && fields >> field; ++number) {
    long value = 0;
    std::from_chars(field.data(), field.data() + field.size(), value);
    if (number == 4) entry.parent = static_cast<pid_t>(value);
    if (number == 24 && value > 0) {
      entry.resident_bytes =
          static_cast<std::size_t>(value) * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    }
  }
  return entry;
}

}  // namespace

std::vector<ProcessEntry> list_processes() {
  std::vector<ProcessEntry> list;
  std::error_code ec;
  for (fs::directory_iterator it("/proc", ec), end; it != end && !ec; it.increment(ec)) {
    const std::string name = it->path().filename();
    pid_t id = 0;
    const auto [last, problem] = std::from_chars(name.data(), name.data() + name.size(), id);
    if (problem != std::errc() || last != name.data() + name.size()) continue;
    const ProcessEntry entry = entry_of(id, it->path());
    if (entry.parent != 0) list.push_back(entry);
  }
  return list;
}

std::size_t descendants_bytes() {
  const std::vector<ProcessEntry> all = list_processes();
  std::set<pid_t> family{::getpid()};
  // A child's number may be lower than its parent's, so once through the list is not enough.
  for (std::size_t before = 0; before != family.size();) {
    before = family.size();
    for (const ProcessEntry& entry : all) {
      if (family.count(entry.parent) != 0) family.insert(entry.id);
    }
  }
  std::size_t bytes = 0;
  for (const ProcessEntry& entry : all) {
    if (entry.id != ::getpid() && family.count(entry.id) != 0) bytes += entry.resident_bytes;
  }
  return bytes;
}

}  // namespace carlo::grader
