#pragma once

#if defined(__linux__)
#include <linux/filter.h>
#endif

#include <cstddef>
#include <vector>

namespace carlo::grader {

#if !defined(__linux__)
/// The kernel's name for an instruction of a filter, where there are none.
struct sock_filter {};
#endif

/// A seccomp filter: the system calls that no exercise needs fail with EPERM. These are sockets,
/// looking into, signalling or slowing other processes, mounts, namespaces, keys, shared memory
/// that outlives its process, rights and owners of files, emptying a file that is not opened for
/// writing, disk that is taken without writing, kernel facilities with a history of holes, leaving
/// the session. Linux's alone: elsewhere it is empty, and install() is false.
class SyscallFilter {
 public:
  /// `own_process_only`: signals and limits reach the filtered process alone, named to limit_to()
  /// before install(). False where namespaces see to that.
  explicit SyscallFilter(bool own_process_only);

  /// For a child after fork(): puts its id where the filter asks for it. Allocates nothing.
  void limit_to(int process);
  /// Filters this process and all that it starts. It needs no privileges but no_new_privs. False
  /// when the kernel refuses. Safe between fork and exec.
  bool install() const;

  const std::vector<sock_filter>& program() const { return program_; }

 private:
  void statement(unsigned code, unsigned value);
  void jump(unsigned test, unsigned value, unsigned char yes, unsigned char no);
  void deny(long call);
  /// It fails with an error other than EPERM.
  void refuse(long call, unsigned error);
  /// O_TRUNC with O_RDONLY, which Linux takes for leave to empty a file, and Landlock for reading.
  void deny_emptying(long call, unsigned flags_at);
  void deny_commands(long call, const std::vector<unsigned>& commands);
  void only_own_process(long call, bool zero_too);

  std::vector<sock_filter> program_;
  std::vector<std::size_t> places_;  ///< of the instructions that compare with the process's id
};

}  // namespace carlo::grader
