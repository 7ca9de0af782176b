#include "grader/grade/apart.h"

#include "course/cli/descriptor.h"
#include "grader/judge/bubblewrap.h"
#include "grader/judge/kinship.h"
#include "grader/judge/landlock.h"
#include "grader/judge/process.h"
#include "grader/judge/syscall_filter.h"
#include "support/error.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string_view>

namespace carlo::grader {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr rlim_t most_memory = rlim_t{2} << 30, most_cpu_seconds = 120;
constexpr std::size_t most_bytes = std::size_t{1} << 30;
constexpr std::chrono::minutes longest{5};

/// The first byte that a child sends: the rest is a result, or an Error's text.
constexpr char returned = 'r', thrown = 'e';

/// The C library declares the kind of limit as a number or an enumeration.
template <class Resource>
bool limit(Resource resource, rlim_t value) {
  const rlimit wanted{value, value};
  return ::setrlimit(resource, &wanted) == 0;
}

std::optional<LandlockRules> rules_for(const fs::path& readable) {
  if (landlock_version() == 0) return {};
  std::optional<LandlockRules> rules(std::in_place);
  for (const fs::path& path : system_paths())
    rules->allow_reading(path);
  if (address_sanitizer()) rules->allow_reading("/proc");
  rules->allow_reading(readable);
  return rules;
}

/// Confines the process. Limits always hold; Landlock and the filter as far as the kernel has them.
bool shut_in(const std::optional<LandlockRules>& rules, pid_t parent) {
  if (!ends_with_parent(SIGKILL) || ::getppid() != parent) return false;
  if (!gains_no_privileges()) return false;
  if (!limit(RLIMIT_CORE, 0) || !limit(RLIMIT_FSIZE, 0)) return false;
  if (!limit(RLIMIT_CPU, most_cpu_seconds)) return false;
  if (!address_sanitizer() && !limit(RLIMIT_AS, most_memory)) return false;
  if (rules && !restrict_to_landlock_rules(rules->descriptor())) return false;
  SyscallFilter filter(true);
  filter.limit_to(::getpid());
  filter.install();
  return true;
}

bool send(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

[[noreturn]] void work(int fd, const std::optional<LandlockRules>& rules, pid_t parent,
                       const std::function<std::string()>& body) {
  if (!shut_in(rules, parent)) ::_exit(127);
  std::string answer;
  try {
    answer = returned + body();
  } catch (const std::exception& error) {
    answer = thrown + std::string(error.what());
  }
  ::_exit(send(fd, answer) ? 0 : 1);
}

/// Reads until the other end is closed; returns nothing if it is too much or takes too long.
std::optional<std::string> all_of(int fd) {
  std::string bytes;
  std::array<char, 65536> block{};
  const Clock::time_point deadline = Clock::now() + longest;
  while (bytes.size() <= most_bytes && Clock::now() < deadline) {
    pollfd waiting{fd, POLLIN, 0};
    if (::poll(&waiting, 1, 1000) <= 0) continue;
    const ssize_t got = ::read(fd, block.data(), block.size());
    if (got == 0) return bytes;
    if (got > 0) bytes.append(block.data(), static_cast<std::size_t>(got));
    if (got < 0 && errno != EINTR) return {};
  }
  return {};
}

std::string end_in_words(int status, bool in_time) {
  if (!in_time) return "it took too long, or gave too much";
  if (WIFSIGNALED(status)) return signal_name(WTERMSIG(status));
  return fmt::format("exit code {}", WEXITSTATUS(status));
}

}  // namespace

std::string apart(const fs::path& readable, const std::function<std::string()>& body) {
  const std::optional<LandlockRules> rules = rules_for(readable);
  Pipe pipe = make_pipe();
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw Error("cannot start a process: {}", std::strerror(errno));
  if (child == 0) work(pipe.write.get(), rules, parent, body);
  pipe.write.close();
  const std::optional<std::string> answer = all_of(pipe.read.get());
  if (!answer) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const bool ended_well = answer && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (!ended_well || answer->empty()) {
    throw Error("{}: reading it was ended: {}", readable.filename().string(),
                end_in_words(status, answer.has_value()));
  }
  if (answer->front() == thrown) throw Error("{}", answer->substr(1));
  return answer->substr(1);
}

}  // namespace carlo::grader
