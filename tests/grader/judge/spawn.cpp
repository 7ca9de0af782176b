#include "grader/judge/spawn.h"

#include "cli/error.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <iterator>

namespace carlo::grader {
namespace {

struct Pipe {
  Descriptor read, write;
};

/// A pipe whose ends lie above the descriptors that the child is given, and do not reach it.
Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw Error("pipe: {}", std::strerror(errno));
  const Descriptor low_read(ends[0]);
  const Descriptor low_write(ends[1]);
  Pipe pipe{Descriptor(::fcntl(ends[0], F_DUPFD_CLOEXEC, 10)),
            Descriptor(::fcntl(ends[1], F_DUPFD_CLOEXEC, 10))};
  if (!pipe.read.open() || !pipe.write.open()) throw Error("pipe: {}", std::strerror(errno));
  if (::fcntl(pipe.read.get(), F_SETFL, O_NONBLOCK) != 0) {
    throw Error("pipe: {}", std::strerror(errno));
  }
  return pipe;
}

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> list;
  std::transform(texts.begin(), texts.end(), std::back_inserter(list),
                 [](const std::string& text) { return const_cast<char*>(text.c_str()); });
  list.push_back(nullptr);
  return list;
}

// From here to exec() only calls that are safe between fork and exec.

bool limit(__rlimit_resource_t resource, rlim_t value) {
  rlimit current{};
  if (::getrlimit(resource, &current) != 0) return false;
  const rlim_t hard = std::min(value, current.rlim_max);
  const rlimit wanted{hard, hard};
  return ::setrlimit(resource, &wanted) == 0;
}

bool apply(const Limits& limits, rlim_t cpu_seconds, bool limit_memory) {
  // Root's processes are never counted; for others the limit counts all that the user runs, so it
  // is a stop for fork bombs and no tight bound.
  constexpr rlim_t processes = 4096;
  return limit(RLIMIT_CORE, 0) && limit(RLIMIT_CPU, cpu_seconds) &&
         limit(RLIMIT_FSIZE, limits.file_bytes) && limit(RLIMIT_NOFILE, limits.open_files) &&
         limit(RLIMIT_NPROC, processes) && (!limit_memory || limit(RLIMIT_AS, limits.memory_bytes));
}

[[noreturn]] void become(const std::vector<char*>& argv, const std::vector<char*>& environment,
                         int input, int output, int result, const Limits& limits, rlim_t cpu) {
  const bool ready =
      ::setsid() >= 0 && ::dup2(input, 0) == 0 && ::dup2(output, 1) == 1 &&
      ::dup2(output, 2) == 2 && ::dup2(result, 3) == 3 && ::close_range(4, ~0U, 0) == 0 &&
      ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && apply(limits, cpu, !address_sanitizer());
  if (ready) ::execve(argv[0], argv.data(), environment.data());
  ::_exit(127);
}

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this == &other) return *this;
  close();
  fd_ = other.fd_;
  other.fd_ = -1;
  return *this;
}

void Descriptor::close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

Child spawn(const std::vector<std::string>& argv, const std::vector<std::string>& environment,
            const Limits& limits) {
  Pipe result = make_pipe();
  Pipe output = make_pipe();
  const Descriptor null(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  if (!null.open()) throw Error("/dev/null: {}", std::strerror(errno));
  const Descriptor input(::fcntl(null.get(), F_DUPFD_CLOEXEC, 10));
  const std::vector<char*> arguments = pointers(argv);
  const std::vector<char*> variables = pointers(environment);
  const auto seconds = std::chrono::ceil<std::chrono::seconds>(limits.deadline).count();

  Child child;
  child.pid = ::fork();
  if (child.pid < 0) throw Error("cannot start a process: {}", std::strerror(errno));
  if (child.pid == 0) {
    become(arguments, variables, input.get(), output.write.get(), result.write.get(), limits,
           static_cast<rlim_t>(seconds + 1));
  }
  child.result = std::move(result.read);
  child.output = std::move(output.read);
  return child;
}

}  // namespace carlo::grader
