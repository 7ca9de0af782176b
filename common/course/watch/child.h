#pragma once

#include "course/cli/descriptor.h"

#include <sys/types.h>

#include <string>
#include <vector>

namespace carlo {

/// A program that runs beside us, in a process group of its own, without input. What it says on
/// stdout and stderr is gathered. Not to be copied; the destructor ends it.
class Child {
 public:
  /// Starts `command` (a program and its arguments; found in PATH). Throws Error.
  explicit Child(const std::vector<std::string>& command);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Readable when it has said something or has ended.
  int fd() const { return fd_.get(); }
  /// Gathers what it has said; true once it has ended.
  bool ended();
  /// Its exit code, or 128 + the signal that ended it. Once ended() was true.
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
