#include "grader/judge/spawn.h"

#include "course/cli/descriptor.h"
#include "course/cli/program.h"
#include "grader/judge/kinship.h"
#include "grader/judge/landlock.h"
#include "support/error.h"

#include <fcntl.h>
#include <grp.h>
#include <sys/resource.h>
#include <unistd.h>
#if defined(__linux__)
#include <linux/close_range.h>
#include <sys/syscall.h>
#endif

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace carlo::grader {
namespace {

/// Makes a pipe whose ends are above the child's descriptors and are not inherited.
Pipe lifted_pipe(bool blocks = false) {
  const Pipe low = make_pipe();
  Pipe pipe{low.read.lifted(), low.write.lifted()};
  if (!blocks && ::fcntl(pipe.read.get(), F_SETFL, O_NONBLOCK) != 0) {
    throw Error("pipe: {}", std::strerror(errno));
  }
  return pipe;
}

#if defined(O_PATH)
constexpr int to_run = O_PATH;
#else
constexpr int to_run = O_RDONLY;
#endif

Descriptor open_lifted(const char* path, int flags) {
  const Descriptor low(::open(path, flags | O_CLOEXEC));
  if (!low.open()) throw Error("{}: {}", path, std::strerror(errno));
  return low.lifted();
}

/// Everything the child needs, made before the fork.
struct Plan {
  std::vector<char*> argv, environment;
  Confinement confinement;
  Limits limits;
  Descriptor program, input;
  int output, result, problem;
  pid_t parent;
};

/// A child's report of a failed step: its number in the list below, and errno.
struct Problem {
  int step = 0, error = 0;
};
constexpr const char* steps[] = {"its session", "its descriptors", "its limits", "its program"};

// From here to exec(): only calls that are safe between fork and exec.

/// `soft`: the limit at which a signal is sent, if different. The C library declares the kind of
/// limit as a number or an enumeration.
template <class Resource>
bool limit(Resource resource, rlim_t value, rlim_t soft = RLIM_INFINITY) {
  rlimit current{};
  if (::getrlimit(resource, &current) != 0) return false;
  const rlim_t hard = std::min(value, current.rlim_max);
  const rlimit wanted{std::min(soft, hard), hard};
  return ::setrlimit(resource, &wanted) == 0;
}

bool apply_limits(const Limits& limits, bool own_user) {
  const auto deadline = std::chrono::ceil<std::chrono::seconds>(limits.deadline).count() + 1;
  // A process that uses up its time gets SIGXCPU a second before SIGKILL, which has other causes
  // too, such as a machine without memory.
  const auto cpu = static_cast<rlim_t>(limits.cpu.count() > 0 ? limits.cpu.count() : deadline);
  // If the user has other processes, the limit counts them too: it stops fork bombs and is no tight
  // bound.
  const rlim_t processes = own_user ? limits.processes : std::max(limits.processes, rlim_t{4096});
  return limit(RLIMIT_CORE, 0) && limit(RLIMIT_CPU, cpu + 1, cpu) &&
         limit(RLIMIT_FSIZE, limits.file_bytes) && limit(RLIMIT_NOFILE, limits.open_files) &&
         limit(RLIMIT_NPROC, processes) &&
         (address_sanitizer() || limit(RLIMIT_AS, limits.memory_bytes));
}

bool become_user(uid_t user) {
#if defined(__linux__)
  return ::setgroups(0, nullptr) == 0 && ::setresgid(user, user, user) == 0 &&
         ::setresuid(user, user, user) == 0;
#else
  return user == ::getuid();
#endif
}

/// Makes all descriptors from `first` on close at exec().
bool close_at_exec(unsigned first) {
#if defined(__linux__)
  if (::close_range(first, ~0U, CLOSE_RANGE_CLOEXEC) == 0) return true;
#endif
  rlimit open{};  // one by one before Linux 5.11 and elsewhere
  if (::getrlimit(RLIMIT_NOFILE, &open) != 0) return false;
  for (rlim_t fd = first; fd < std::min(open.rlim_cur, rlim_t{65536}); ++fd)
    ::fcntl(static_cast<int>(fd), F_SETFD, FD_CLOEXEC);
  return true;
}

bool set_descriptors(const Plan& plan) {
  const int inherited = plan.confinement.inherited, status = plan.confinement.status;
  return ::dup2(plan.input.get(), 0) == 0 && ::dup2(plan.output, 1) == 1 &&
         ::dup2(plan.output, 2) == 2 && ::dup2(plan.result, 3) == 3 && close_at_exec(4) &&
         (inherited < 0 || ::dup2(inherited, 4) == 4) && (status < 0 || ::dup2(status, 5) == 5);
}

/// If memory runs out, the kernel kills these programs before those that judge them. Failure to set
/// this is harmless.
void go_first() {
  const int file = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  [[maybe_unused]] const ssize_t written = ::write(file, "1000", 4);
  ::close(file);
}

/// The order matters: steps that need privileges first, the system call filter last. Changing the
/// user clears the parent-death signal, so that is requested afterwards.
bool confine(Plan& plan) {
  Confinement& own = plan.confinement;
  if (!own.folder.empty() && ::chdir(own.folder.c_str()) != 0) return false;
  if (own.user && !become_user(*own.user)) return false;
  if (!ends_with_parent(SIGKILL) || ::getppid() != plan.parent) return false;
  if (!gains_no_privileges()) return false;
  if (!apply_limits(plan.limits, own.user.has_value())) return false;
  if (own.landlock_rules >= 0 && !restrict_to_landlock_rules(own.landlock_rules)) return false;
  if (!own.filter) return true;
  own.filter->limit_to(::getpid());
  return own.filter->install();
}

/// Runs the steps up to the program; returns the number of the one that failed.
int begin(Plan& plan) {
  if (::setsid() < 0) return 0;
  if (plan.confinement.untrusted) go_first();
  if (!set_descriptors(plan)) return 1;
  if (!confine(plan)) return 2;
    // By its descriptor, opened with our rights: the child's user may have no access to the folders
    // above.
#if defined(__linux__)
  ::syscall(SYS_execveat, plan.program.get(), "", plan.argv.data(), plan.environment.data(),
            AT_EMPTY_PATH);
  if (errno != ENOSYS) return 3;
#endif
  // By its path elsewhere, and where QEMU emulates a kernel for another processor.
  ::execve(plan.argv.front(), plan.argv.data(), plan.environment.data());
  return 3;
}

[[noreturn]] void become(Plan& plan) {
  const int step = begin(plan);
  const Problem problem{step, errno};
  [[maybe_unused]] const ssize_t written = ::write(plan.problem, &problem, sizeof problem);
  ::_exit(127);
}

// Back in the parent.

/// Waits until the child has started its program, which closes the pipe's other end, or has
/// reported why not.
std::string problem_told(const Descriptor& read_end) {
  Problem problem;
  ssize_t got = 0;
  do {
    got = ::read(read_end.get(), &problem, sizeof problem);
  } while (got < 0 && errno == EINTR);
  if (got != sizeof problem) return "";
  return fmt::format("{}: {}", steps[problem.step], std::strerror(problem.error));
}

}  // namespace

Spawned spawn(const Command& command, const Limits& limits) {
  Pipe result = lifted_pipe();
  Pipe output = lifted_pipe();
  Pipe problem = lifted_pipe(true);
  Plan plan{pointers(command.argv),
            pointers(command.environment),
            command.confinement,
            limits,
            open_lifted(command.argv.at(0).c_str(), to_run),
            open_lifted("/dev/null", O_RDONLY),
            output.write.get(),
            result.write.get(),
            problem.write.get(),
            ::getpid()};
  Spawned child;
  child.pid = ::fork();
  if (child.pid < 0) throw Error("cannot start a process: {}", std::strerror(errno));
  if (child.pid == 0) become(plan);
  problem.write.close();
  child.problem = problem_told(problem.read);
  child.result = std::move(result.read);
  child.output = std::move(output.read);
  return child;
}

}  // namespace carlo::grader
