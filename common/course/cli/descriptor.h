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

  /// The same file under a number of at least 10, out of the way of those that a child is given,
  /// and closed at exec(). Throws Error when this one is not open.
  Descriptor lifted() const;

 private:
  int fd_;
};

struct Pipe {
  Descriptor read, write;
};

/// A pipe whose ends close at exec(). Throws Error when there is none to be had.
Pipe make_pipe();

}  // namespace carlo
