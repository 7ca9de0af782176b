#pragma once

#include "course/cli/descriptor.h"

#include <sys/types.h>

#include <string>
#include <vector>

namespace carlo {

/// A program that runs in the background, in its own process group, without input. Its stdout and
/// stderr are collected. Not copyable; the destructor ends the program.
class Child {
 public:
  /// Starts `command` (a program and its arguments; looked up in PATH). Throws Error.
  explicit Child(const std::vector<std::string>& command);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Readable when the program has written something or has ended.
  int fd() const { return fd_.get(); }
  /// Collects new output; returns whether the program has ended.
  bool ended();
  /// Returns its exit code, or 128 + the signal that ended it. Only once ended() was true.
  int exit_code() const { return exit_code_; }
  const std::string& output() const { return output_; }

 private:
  void wait();

  pid_t pid_ = -1;
  Descriptor fd_;
  int exit_code_ = 0;
  std::string output_;
};

}  // namespace carlo
