#include "grader/judge/survivors.h"

#include "cli/error.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

/// The parent of a process, from /proc/PID/stat; 0 when it has just ended. The name in the second
/// field may hold anything, so the fields are counted from its last parenthesis.
pid_t parent_of(const fs::path& process) {
  std::ifstream file(process / "stat");
  std::string line;
  std::getline(file, line);
  const auto name_end = line.rfind(')');
  if (name_end == std::string::npos || name_end + 4 > line.size()) return 0;
  pid_t parent = 0;
  std::from_chars(line.data() + name_end + 4, line.data() + line.size(), parent);
  return parent;
}

void kill_children() {
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator("/proc", ec)) {
    const std::string name = entry.path().filename();
    pid_t pid = 0;
    const auto [end, problem] = std::from_chars(name.data(), name.data() + name.size(), pid);
    if (problem != std::errc() || end != name.data() + name.size()) continue;
    if (parent_of(entry.path()) == ::getpid()) ::kill(pid, SIGKILL);
  }
}

/// Reaps what has ended and notes how large it was. True while children remain.
bool reap(std::size_t& peak) {
  while (true) {
    rusage usage{};
    const pid_t got = ::wait4(-1, nullptr, WNOHANG, &usage);
    if (got == 0) return true;
    if (got < 0 && errno != EINTR) return false;
    if (got > 0) peak = std::max(peak, static_cast<std::size_t>(usage.ru_maxrss) * 1024);
  }
}

}  // namespace

void adopt_orphans() {
  if (::prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) != 0) {
    throw Error("cannot become the reaper of orphans: {}", std::strerror(errno));
  }
}

std::size_t end_orphans() {
  std::size_t peak = 0;
  const auto start = std::chrono::steady_clock::now();
  // Killing a parent hands us its children, so we look again until none is left.
  while (reap(peak)) {
    if (std::chrono::steady_clock::now() - start > std::chrono::seconds(10)) {
      throw Error("processes of the worker could not be ended");
    }
    kill_children();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return peak;
}

}  // namespace carlo::grader
