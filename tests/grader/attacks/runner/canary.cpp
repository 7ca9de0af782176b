#include "canary.h"

#include "support/error.h"

#include <fmt/core.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <csignal>
#include <fstream>
#include <system_error>
#include <thread>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;

/// The ids that the sandbox gives to programs begin here.
constexpr uid_t first_sandbox_user = 61200;

/// Kind, rights, owner, size, and when any of them or the content changed last: the kernel sets
/// that time, and no call sets it back. Reading gigabytes to compare contents takes a minute
/// instead.
std::string picture_of(const fs::path& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) return "unreadable";
  return fmt::format("{:o} {} {} {} {}.{}", status.st_mode, status.st_uid, status.st_size,
                     status.st_ino, status.st_ctim.tv_sec, status.st_ctim.tv_nsec);
}

/// The parent's id and the name of a process, from /proc/PID/stat.
std::pair<pid_t, std::string> parent_and_name(const fs::path& process) {
  std::ifstream file(process / "stat");
  std::string line;
  std::getline(file, line);
  const auto open = line.find('('), close = line.rfind(')');
  if (close == std::string::npos || close + 4 > line.size()) return {0, ""};
  pid_t parent = 0;
  std::from_chars(line.data() + close + 4, line.data() + line.size(), parent);
  return {parent, line.substr(open, close - open + 1)};
}

}  // namespace

Canary::Canary(std::vector<fs::path> folders, std::vector<fs::path> listed)
    : folders_(std::move(folders)), listed_(std::move(listed)), before_(look()) {}

Canary::Picture Canary::look() const {
  Picture picture;
  for (const fs::path& folder : folders_) {
    picture[folder.string()] = picture_of(folder);
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      picture[entry.path().string()] = picture_of(entry.path());
  }
  for (const fs::path& folder : listed_) {
    std::error_code ec;
    for (const auto& entry : fs::directory_iterator(folder, ec)) {
      if (entry.path().filename().string().starts_with("carlo-")) continue;  // another grader's
      struct stat status {};
      if (::lstat(entry.path().c_str(), &status) == 0 && status.st_uid >= first_sandbox_user) {
        picture[entry.path().string()] = fmt::format("of user {}", status.st_uid);
      }
    }
  }
  return picture;
}

std::vector<std::string> Canary::changes() const {
  const Picture now = look();
  std::vector<std::string> list;
  for (const auto& [path, was] : before_) {
    const auto found = now.find(path);
    if (found == now.end()) {
      list.push_back(path + " is gone");
    } else if (found->second != was) {
      list.push_back(path + " has changed");
    }
  }
  for (const auto& [path, is] : now) {
    if (before_.count(path) == 0) list.push_back(path + " is new");
  }
  return list;
}

void gather_orphans() {
  if (::prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) != 0) throw Error("no orphans can be gathered");
}

std::vector<std::string> end_those_left() {
  std::vector<std::string> list;
  // Ending a parent makes its children ours: repeat until there are none.
  while (::waitpid(-1, nullptr, WNOHANG) >= 0) {
    for (const auto& entry : fs::directory_iterator("/proc")) {
      const std::string id = entry.path().filename();
      pid_t pid = 0;
      std::from_chars(id.data(), id.data() + id.size(), pid);
      if (pid == 0) continue;
      const auto [parent, name] = parent_and_name(entry.path());
      if (parent != ::getpid()) continue;
      list.push_back(fmt::format("process {} {}", pid, name));
      ::kill(pid, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return list;
}

}  // namespace carlo::grader
