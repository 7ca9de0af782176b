#pragma once

#include "grader/judge/process.h"

#include <sys/types.h>

#include <string>
#include <vector>

namespace carlo::grader {

/// A descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
  Descriptor& operator=(Descriptor&& other) noexcept;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  int get() const { return fd_; }
  bool open() const { return fd_ >= 0; }
  void close();

 private:
  int fd_;
};

/// A child process and the ends of its pipes that we read from (they do not block).
struct Child {
  pid_t pid = -1;
  Descriptor result;  ///< its descriptor 3
  Descriptor output;  ///< its descriptors 1 and 2
};

/// Starts a process as run_limited() says. Throws Error when the system refuses.
Child spawn(const std::vector<std::string>& argv, const std::vector<std::string>& environment,
            const Limits& limits);

}  // namespace carlo::grader
