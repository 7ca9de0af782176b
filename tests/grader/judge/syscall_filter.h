#pragma once

#if defined(__linux__)
#include <linux/filter.h>
#endif

#include <cstddef>
#include <vector>

namespace carlo::grader {

#if !defined(__linux__)
/// Stands in for the kernel's filter instruction, on systems without filters.
struct sock_filter {};
#endif

/// A seccomp filter: the system calls that no exercise needs fail with EPERM. These are sockets,
/// inspecting, signalling or slowing other processes, mounts, namespaces, keys, shared memory that
/// outlives its process, permissions and owners of files, truncating a file without opening it for
/// writing, allocating disk without writing, kernel facilities with a history of vulnerabilities,
/// leaving the session. Linux only: elsewhere it is empty, and install() returns false.
class SyscallFilter {
 public:
  /// `own_process_only`: signals and limits may target only the filtered process, passed to
  /// limit_to() before install(). False if namespaces ensure that.
  explicit SyscallFilter(bool own_process_only);

  /// For a child after fork(): inserts its id into the filter. Does not allocate.
  void limit_to(int process);
  /// Filters this process and all that it starts. Needs no privileges except no_new_privs. Returns
  /// false if the kernel refuses. Safe between fork and exec.
  bool install() const;

  const std::vector<sock_filter>& program() const { return program_; }

 private:
  void statement(unsigned code, unsigned value);
  void jump(unsigned test, unsigned value, unsigned char yes, unsigned char no);
  void deny(long call);
  /// Makes the call fail with an error other than EPERM.
  void refuse(long call, unsigned error);
  /// Denies O_TRUNC with O_RDONLY, which Linux accepts for truncating a file although Landlock
  /// takes it for reading.
  void deny_emptying(long call, unsigned flags_at);
  void deny_commands(long call, const std::vector<unsigned>& commands);
  void only_own_process(long call, bool zero_too);

  std::vector<sock_filter> program_;
  std::vector<std::size_t> places_;  ///< of the instructions that compare with the process id
};

}  // namespace carlo::grader
