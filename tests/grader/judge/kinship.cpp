#include "grader/judge/kinship.h"

#include "grader/judge/process_list.h"
#include "support/error.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#if defined(__linux__)
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

namespace carlo::grader {

#if defined(__linux__)

bool ends_with_parent(int signal) {
  return ::prctl(PR_SET_PDEATHSIG, signal, 0, 0, 0) == 0;
}

bool adopts_orphans() {
  // Every kernel since 3.4 has this; QEMU's emulation of one for another processor does not.
  return ::prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) == 0 || errno == EINVAL;
}

bool gains_no_privileges() {
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
}

#else

bool ends_with_parent(int) {
  return true;
}

bool adopts_orphans() {
  return true;
}

bool gains_no_privileges() {
  return true;
}

#endif

namespace {

void kill_descendants() {
  for (const ProcessEntry& entry : descendants_of(::getpid()))
    ::kill(entry.id, SIGKILL);
}

/// Reaps ended children and records how large they were. Returns true while children remain.
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
  if (!adopts_orphans())
    throw Error("cannot become the reaper of orphans: {}", std::strerror(errno));
}

std::size_t end_orphans() {
  std::size_t peak = 0;
  const auto start = std::chrono::steady_clock::now();
  // More may be started meanwhile, and killing a parent gives us its children: repeat until none is
  // left.
  while (reap(peak)) {
    if (std::chrono::steady_clock::now() - start > std::chrono::seconds(10)) {
      throw Error("processes that the program started could not be ended");
    }
    kill_descendants();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return peak;
}

}  // namespace carlo::grader
