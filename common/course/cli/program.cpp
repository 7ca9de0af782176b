#include "course/cli/program.h"

#include "course/cli/descriptor.h"
#include "support/error.h"

#include <fmt/ranges.h>
#include <sys/wait.h>
#include <unistd.h>
#if defined(__linux__)
#include <sys/prctl.h>
#elif defined(__APPLE__)
#include <mach-o/dyld.h>
#endif

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <utility>

namespace carlo {
namespace {

/// Runs in the child between fork and exec: makes system calls only.
[[noreturn]] void become(const std::vector<char*>& argv, const ProgramStart& how, pid_t parent) {
  sigset_t none;
  bool ready = true;
  if (how.own_group) {
    ready = ::sigemptyset(&none) == 0 && ::sigprocmask(SIG_SETMASK, &none, nullptr) == 0 &&
            ::setpgid(0, 0) == 0;
  }
  if (how.ends_with_us) {
#if defined(__linux__)
    ready = ready && ::prctl(PR_SET_PDEATHSIG, SIGKILL) == 0;
#endif
    ready = ready && ::getppid() == parent;
  }
  for (const auto& [from, to] :
       {std::pair{how.notices, 3}, std::pair{how.input, STDIN_FILENO},
        std::pair{how.output, STDOUT_FILENO}, std::pair{how.error, STDERR_FILENO}})
    ready = ready && (from < 0 || ::dup2(from, to) == to);
  if (ready) ::execvp(argv[0], argv.data());
  for (const char* word : {static_cast<const char*>(argv[0]), ": cannot be run\n"})
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, word, std::strlen(word));
  ::_exit(127);
}

}  // namespace

std::vector<char*> pointers(const std::vector<std::string>& words) {
  std::vector<char*> list;
  list.reserve(words.size() + 1);
  for (const std::string& word : words)
    list.push_back(const_cast<char*>(word.c_str()));
  list.push_back(nullptr);
  return list;
}

std::string own_path() {
#if defined(__APPLE__)
  std::string path(4096, '\0');
  auto size = static_cast<std::uint32_t>(path.size());
  if (::_NSGetExecutablePath(path.data(), &size) != 0)
    throw Error("the program's own path is too long");
  return path.c_str();
#else
  return "/proc/self/exe";
#endif
}

pid_t start_program(const std::vector<std::string>& words, const ProgramStart& how) {
  const std::vector<char*> argv = pointers(words);
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) throw Error("cannot start a process: {}", std::strerror(errno));
  if (child == 0) become(argv, how, parent);
  // Here as well, so that whoever kills the group at once finds it; fails if the child was first.
  if (how.own_group) (void)::setpgid(child, child);
  return child;
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw Error("cannot wait for a program: {}", std::strerror(errno));
  }
  return status;
}

std::string output_of(const std::vector<std::string>& words) {
  Pipe pipe = make_pipe();
  const pid_t child = start_program(words, {.output = pipe.write.get()});
  pipe.write.close();
  std::string text;
  std::array<char, 4096> piece{};
  for (ssize_t n = 0; (n = ::read(pipe.read.get(), piece.data(), piece.size())) != 0;) {
    if (n > 0) text.append(piece.data(), static_cast<std::size_t>(n));
    if (n < 0 && errno != EINTR) break;
  }
  if (wait_for(child) != 0) throw Error("this failed: {}", fmt::join(words, " "));
  return text;
}

}  // namespace carlo
