#include "grader/judge/process_list.h"

#include "course/cli/descriptor.h"
#include "support/number.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <system_error>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

/// Reads a file of /proc, which one read() returns in full. Streams take three times as long, and a
/// judge reads the files of all processes ten times a second.
std::string proc_file(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  std::array<char, 2048> text{};
  const ssize_t got = file.open() ? ::read(file.get(), text.data(), text.size()) : 0;
  return {text.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0))};
}

std::string proc_file(pid_t id, const char* name) {
  return proc_file(fmt::format("/proc/{}/{}", id, name));
}

/// Parses /proc/PID/stat. The name in the second field may hold anything, so fields are counted
/// from its last parenthesis: the 3rd is the state, the 4th the parent's id, the 14th to 17th the
/// ticks of processor time, the 20th the number of threads, the 24th the resident pages.
ProcessEntry entry_of(pid_t id) {
  ProcessEntry entry{id};
  const std::string line = proc_file(id, "stat");
  const auto name_end = line.rfind(')');
  if (name_end == std::string::npos) return entry;
  std::size_t at = name_end + 2;
  for (int number = 3; number <= 24 && at < line.size(); ++number) {
    long value = 0;
    std::from_chars(line.data() + at, line.data() + line.size(), value);
    if (number == 3) entry.state = line[at];
    if (number == 4) entry.parent = static_cast<pid_t>(value);
    if (number >= 14 && number <= 17) {
      entry.seconds += static_cast<double>(value) / static_cast<double>(::sysconf(_SC_CLK_TCK));
    }
    if (number == 20 && value > 0) entry.threads = static_cast<std::size_t>(value);
    if (number == 24 && value > 0) {
      entry.resident_bytes =
          static_cast<std::size_t>(value) * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    }
    at = std::min(line.find(' ', at), line.size() - 1) + 1;
  }
  return entry;
}

/// Returns the numeric names in a folder: in /proc, the ids of all current processes.
std::vector<pid_t> ids_in(const fs::path& folder) {
  std::vector<pid_t> ids;
  std::error_code ec;
  for (fs::directory_iterator it(folder, ec), end; it != end && !ec; it.increment(ec)) {
    const std::string name = it->path().filename();
    if (const auto id = number_of<pid_t>(name)) ids.push_back(*id);
  }
  return ids;
}

/// Parses a file with nanoseconds on a processor, and nanoseconds of waiting for one.
ThreadTimes times_in(const std::string& schedstat) {
  std::istringstream words(proc_file(schedstat));
  double ran = 0, waited = 0;
  if (!(words >> ran >> waited)) return {};
  return {ran * 1e-9, waited * 1e-9};
}

/// Parses /proc/PID/task/TID/stat, like entry_of().
bool is_ready(const std::string& stat) {
  const std::string line = proc_file(stat);
  const auto name_end = line.rfind(')');
  return name_end != std::string::npos && line.substr(name_end).starts_with(") R");
}

}  // namespace

std::vector<ProcessEntry> list_processes() {
  std::vector<ProcessEntry> list;
  for (const pid_t id : ids_in("/proc")) {
    const ProcessEntry entry = entry_of(id);
    if (entry.parent != 0) list.push_back(entry);
  }
  return list;
}

std::vector<ProcessEntry> descendants_of(pid_t ancestor) {
  std::multimap<pid_t, ProcessEntry> children;
  for (const ProcessEntry& entry : list_processes())
    children.insert({entry.parent, entry});
  std::vector<ProcessEntry> family;
  std::vector<pid_t> parents{ancestor};
  while (!parents.empty()) {
    const auto [begin, end] = children.equal_range(parents.back());
    parents.pop_back();
    for (auto child = begin; child != end; ++child) {
      family.push_back(child->second);
      parents.push_back(child->second.id);
    }
  }
  return family;
}

std::vector<ThreadEntry> list_threads(const ProcessEntry& process) {
  const std::string folder = fmt::format("/proc/{}/task", process.id);
  std::vector<ThreadEntry> list;
  for (const pid_t id : ids_in(folder)) {
    const std::string thread = fmt::format("{}/{}", folder, id);
    const bool ready = id == process.id ? process.state == 'R' : is_ready(thread + "/stat");
    list.push_back({id, ready, times_in(thread + "/schedstat")});
  }
  return list;
}

ThreadTimes own_times() {
  return times_in("/proc/thread-self/schedstat");
}

std::size_t page_table_bytes(pid_t id) {
  std::istringstream words(proc_file(id, "status"));
  for (std::string word; words >> word;) {
    std::size_t kilobytes = 0;
    if (word == "VmPTE:" && words >> kilobytes) return kilobytes << 10;
  }
  return 0;
}

bool has_process_of(uid_t user) {
  for (const pid_t id : ids_in("/proc")) {
    std::istringstream words(proc_file(id, "status"));
    for (std::string word; words >> word;) {
      if (word != "Uid:") continue;
      uid_t real = 0, effective = 0, saved = 0;
      words >> real >> effective >> saved;
      if (real == user || effective == user || saved == user) return true;
      break;
    }
  }
  return false;
}

}  // namespace carlo::grader
