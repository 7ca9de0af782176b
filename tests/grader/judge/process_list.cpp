#include "grader/judge/process_list.h"

#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

/// From /proc/PID/stat. The name in the second field may hold anything, so the fields are counted
/// from its last parenthesis: the parent's id is the 4th, the ticks of processor time are the 14th
/// to 17th, the resident pages are the 24th.
ProcessEntry entry_of(pid_t id, const fs::path& folder) {
  ProcessEntry entry{id, 0, 0, 0};
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
    if (number >= 14 && number <= 17) {
      entry.seconds += static_cast<double>(value) / static_cast<double>(::sysconf(_SC_CLK_TCK));
    }
    if (number == 24 && value > 0) {
      entry.resident_bytes =
          static_cast<std::size_t>(value) * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    }
  }
  return entry;
}

/// The ids of all processes that are there now.
std::vector<pid_t> process_ids() {
  std::vector<pid_t> ids;
  std::error_code ec;
  for (fs::directory_iterator it("/proc", ec), end; it != end && !ec; it.increment(ec)) {
    const std::string name = it->path().filename();
    pid_t id = 0;
    const auto [last, problem] = std::from_chars(name.data(), name.data() + name.size(), id);
    if (problem == std::errc() && last == name.data() + name.size()) ids.push_back(id);
  }
  return ids;
}

fs::path folder_of(pid_t id) {
  return fs::path("/proc") / std::to_string(id);
}

}  // namespace

std::vector<ProcessEntry> list_processes() {
  std::vector<ProcessEntry> list;
  for (const pid_t id : process_ids()) {
    const ProcessEntry entry = entry_of(id, folder_of(id));
    if (entry.parent != 0) list.push_back(entry);
  }
  return list;
}

bool has_process_of(uid_t user) {
  for (const pid_t id : process_ids()) {
    std::ifstream file(folder_of(id) / "status");
    for (std::string word; file >> word;) {
      if (word != "Uid:") continue;
      uid_t real = 0, effective = 0, saved = 0;
      file >> real >> effective >> saved;
      if (real == user || effective == user || saved == user) return true;
      break;
    }
  }
  return false;
}

}  // namespace carlo::grader
