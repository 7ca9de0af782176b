#pragma once

namespace carlo {

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

  /// Duplicates the descriptor to a number of at least 10, above those that a child is given,
  /// closed at exec(). Throws Error if this one is not open.
  Descriptor lifted() const;

 private:
  int fd_;
};

struct Pipe {
  Descriptor read, write;
};

/// Makes a pipe whose ends close at exec(). Throws Error if none is available.
Pipe make_pipe();

}  // namespace carlo
