#include "cli/descriptor.h"

#include "cli/error.h"

#include <fcntl.h>
#include <unistd.h>

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

}  // namespace carlo
