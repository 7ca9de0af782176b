#include "course/cli/descriptor.h"

#include "support/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace carlo {

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

Descriptor Descriptor::lifted() const {
  Descriptor copy(::fcntl(fd_, F_DUPFD_CLOEXEC, 10));
  if (!copy.open()) throw Error("cannot copy a descriptor: {}", std::strerror(errno));
  return copy;
}

Pipe make_pipe() {
  std::array<int, 2> ends{};
#if defined(__APPLE__)
  // Without pipe2() a program that another thread starts between these calls inherits the ends too.
  bool made = ::pipe(ends.data()) == 0;
  for (const int end : ends)
    made = made && ::fcntl(end, F_SETFD, FD_CLOEXEC) == 0;
#else
  const bool made = ::pipe2(ends.data(), O_CLOEXEC) == 0;
#endif
  if (!made) throw Error("no pipe: {}", std::strerror(errno));
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

}  // namespace carlo
