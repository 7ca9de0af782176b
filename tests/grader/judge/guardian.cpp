#include "grader/judge/guardian.h"

#include "grader/judge/kinship.h"
#include "support/error.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>

namespace carlo::grader {
namespace {

/// Returns the signals that a guardian waits for: a child's end, and the caller's.
sigset_t awaited() {
  sigset_t set{};
  ::sigemptyset(&set);
  ::sigaddset(&set, SIGCHLD);
  ::sigaddset(&set, SIGTERM);
  return set;
}

/// Returns how the body ended; "killed" if the caller is gone.
int wait_for(pid_t child, pid_t caller) {
  [[maybe_unused]] const sigset_t signals = awaited();
  while (true) {
    int status = 0;
    pid_t ended = 0;
    // The others are orphans of the body.
    while ((ended = ::waitpid(-1, &status, WNOHANG)) > 0) {
      if (ended == child) return status;
    }
    if (::getppid() != caller) return SIGKILL;
#if defined(__APPLE__)
    // sigtimedwait() is missing here: the signals stay pending.
    const timespec moment{0, 20'000'000};
    ::nanosleep(&moment, nullptr);
#else
    // A missed signal costs a second.
    const timespec second{1, 0};
    ::sigtimedwait(&signals, nullptr, &second);
#endif
  }
}

/// Ends this process in the way another one ended.
[[noreturn]] void end_as(int status) {
  if (WIFSIGNALED(status)) {
    std::signal(WTERMSIG(status), SIG_DFL);
    ::kill(::getpid(), WTERMSIG(status));
    ::_exit(128 + WTERMSIG(status));
  }
  ::_exit(WEXITSTATUS(status));
}

[[noreturn]] void guard(const std::function<int()>& body, pid_t caller) {
  // Out of reach of the terminal's signals, and of whoever kills the caller's group.
  ::setsid();
  sigset_t signals = awaited(), before{};
  ::sigprocmask(SIG_BLOCK, &signals, &before);
  if (!adopts_orphans() || !ends_with_parent(SIGTERM)) ::_exit(1);
  const pid_t guardian = ::getpid(), child = ::fork();
  if (child < 0) ::_exit(1);
  if (child == 0) {
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    int code = 1;
    if (ends_with_parent(SIGKILL) && ::getppid() == guardian) code = body();
    std::fflush(nullptr);
    ::_exit(code);
  }
  const int status = wait_for(child, caller);
  for (int attempt = 0; attempt < 6; ++attempt) {
    try {
      end_orphans();
      break;
    } catch (const Error&) {
      // Tries for ten more seconds.
    }
  }
  end_as(status);
}

}  // namespace

pid_t start_guarded(const std::function<int()>& body) {
  std::fflush(nullptr);
  const pid_t caller = ::getpid();
  const pid_t guardian = ::fork();
  if (guardian < 0) throw Error("cannot start a process: {}", std::strerror(errno));
  if (guardian == 0) guard(body, caller);
  return guardian;
}

}  // namespace carlo::grader
