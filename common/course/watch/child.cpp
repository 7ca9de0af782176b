#include "course/watch/child.h"

#include "course/cli/program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <utility>

namespace carlo {
Child::Child(const std::vector<std::string>& command) {
  Pipe pipe = make_pipe();
  fd_ = std::move(pipe.read);
  const Descriptor out = std::move(pipe.write), none(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  pid_ = start_program(
      command, {.input = none.get(), .output = out.get(), .error = out.get(), .own_group = true});
  ::fcntl(fd_.get(), F_SETFL, O_NONBLOCK);
}

Child::~Child() {
  if (pid_ > 0) {
    // The whole group, so that a compiler or a judge's worker ends too.
    ::kill(-pid_, SIGTERM);
    wait();
  }
}

void Child::wait() {
  const int status = wait_for(pid_);
  exit_code_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  pid_ = -1;
}

bool Child::ended() {
  std::array<char, 4096> buffer{};
  while (true) {
    const ssize_t got = ::read(fd_.get(), buffer.data(), buffer.size());
    if (got > 0) {
      output_.append(buffer.data(), static_cast<std::size_t>(got));
    } else if (got == 0) {
      if (pid_ > 0) wait();
      return true;
    } else if (errno != EINTR) {
      return false;
    }
  }
}

}  // namespace carlo
