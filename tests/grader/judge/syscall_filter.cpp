#include "grader/judge/syscall_filter.h"

#if defined(__linux__)

#include <asm/ioctls.h>
#include <asm/sockios.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <cerrno>
#include <cstdint>

namespace carlo::grader {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
#error "the system calls of this machine are not known to the sandbox"
#endif

constexpr unsigned refusal = SECCOMP_RET_ERRNO | EPERM;

// Those above 423 have the same number on every machine; older headers lack some names.
constexpr long denied[] = {
    // the network, and sockets of any kind
    SYS_socket,
    SYS_socketpair,
    // other processes
    SYS_ptrace,
    SYS_process_vm_readv,
    SYS_process_vm_writev,
    SYS_kcmp,
    424,  // pidfd_send_signal
    434,  // pidfd_open
    438,  // pidfd_getfd
    440,  // process_madvise
    SYS_setsid,
    SYS_setpriority,  // of all processes of the user
    SYS_ioprio_set,
    SYS_migrate_pages,
    SYS_move_pages,
    // the file system's shape
    SYS_mount,
    SYS_umount2,
    SYS_pivot_root,
    SYS_chroot,
    SYS_quotactl,
    SYS_swapon,
    SYS_swapoff,
    SYS_mknodat,
    SYS_open_by_handle_at,
    SYS_name_to_handle_at,
    428,  // open_tree
    429,  // move_mount
    430,  // fsopen
    431,  // fsconfig
    432,  // fsmount
    433,  // fspick
    442,  // mount_setattr
    SYS_fanotify_init,
    // namespaces
    SYS_unshare,
    SYS_setns,
    // a file's size by its path: Landlock controls it only from version 3 on
    SYS_truncate,
    437,  // openat2, whose flags no filter can read
    // memory and queues that outlive their process, or that no limit counts
    SYS_shmget,
    SYS_semget,
    SYS_msgget,
    SYS_mq_open,
    SYS_memfd_create,
    447,  // memfd_secret
    SYS_io_setup,
    // parts of the kernel that no exercise needs
    SYS_bpf,
    SYS_perf_event_open,
    SYS_userfaultfd,
    SYS_add_key,
    SYS_request_key,
    SYS_keyctl,
    425,  // io_uring_setup
    426,  // io_uring_enter
    427,  // io_uring_register
    SYS_init_module,
    SYS_finit_module,
    SYS_delete_module,
    SYS_kexec_load,
    SYS_reboot,
    SYS_acct,
    SYS_syslog,
    SYS_settimeofday,
    SYS_clock_settime,
    SYS_clock_adjtime,
    SYS_sethostname,
    SYS_setdomainname,
    SYS_personality,
    SYS_vhangup,
#if defined(__x86_64__)
    SYS_mknod,
    SYS_modify_ldt,
    SYS_iopl,
    SYS_ioperm,
#endif
};

// Permissions, owners and times of files: Landlock does not control them, and if the sandbox has no
// user of its own they may be those of our files, or of the machine's devices, if it is root's.
constexpr long denied_on_our_disk[] = {
    SYS_fchmod,    SYS_fchmodat,
    452,  // fchmodat2
    SYS_fchown,    SYS_fchownat,    SYS_utimensat,    SYS_setxattr,     SYS_lsetxattr,
    SYS_fsetxattr, SYS_removexattr, SYS_lremovexattr, SYS_fremovexattr,
    463,  // setxattrat
    466,  // removexattrat
#if defined(__x86_64__)
    SYS_chmod,     SYS_chown,       SYS_lchown,       SYS_utime,        SYS_utimes,
    SYS_futimesat,
#endif
};

constexpr unsigned new_namespaces = CLONE_NEWNS | CLONE_NEWCGROUP | CLONE_NEWUTS | CLONE_NEWIPC |
                                    CLONE_NEWUSER | CLONE_NEWPID | CLONE_NEWNET;

// A descriptor's owner gets a chosen signal when there is something to read: kill() by another
// name. A lease makes whoever opens the file wait.
const std::vector<unsigned> denied_fcntl{F_SETOWN, F_SETOWN_EX, F_SETSIG, F_SETLEASE};
const std::vector<unsigned> denied_ioctl{FIOSETOWN, SIOCSPGRP, TIOCSTI};

/// The lower halves of a system call's arguments: process ids, commands and clone's flags fit in
/// them.
constexpr unsigned first_argument = offsetof(seccomp_data, args);
constexpr unsigned second_argument = first_argument + sizeof(std::uint64_t);
constexpr unsigned third_argument = second_argument + sizeof(std::uint64_t);

}  // namespace

void SyscallFilter::statement(unsigned code, unsigned value) {
  program_.push_back({static_cast<std::uint16_t>(code), 0, 0, value});
}

void SyscallFilter::jump(unsigned test, unsigned value, unsigned char yes, unsigned char no) {
  program_.push_back({static_cast<std::uint16_t>(BPF_JMP | BPF_K | test), yes, no, value});
}

void SyscallFilter::deny(long call) {
  jump(BPF_JEQ, static_cast<unsigned>(call), 0, 1);
  statement(BPF_RET | BPF_K, refusal);
}

void SyscallFilter::deny_commands(long call, const std::vector<unsigned>& commands) {
  const auto rest = static_cast<unsigned char>(2 * commands.size() + 2);
  jump(BPF_JEQ, static_cast<unsigned>(call), 0, rest);
  statement(BPF_LD | BPF_W | BPF_ABS, second_argument);
  for (const unsigned command : commands) {
    jump(BPF_JEQ, command, 0, 1);
    statement(BPF_RET | BPF_K, refusal);
  }
  statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
}

void SyscallFilter::refuse(long call, unsigned error) {
  jump(BPF_JEQ, static_cast<unsigned>(call), 0, 1);
  statement(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | error);
}

void SyscallFilter::deny_emptying(long call, unsigned flags_at) {
  jump(BPF_JEQ, static_cast<unsigned>(call), 0, 5);
  statement(BPF_LD | BPF_W | BPF_ABS, flags_at);
  statement(BPF_ALU | BPF_AND | BPF_K, O_TRUNC | O_ACCMODE);
  jump(BPF_JEQ, O_TRUNC | O_RDONLY, 0, 1);
  statement(BPF_RET | BPF_K, refusal);
  statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
}

void SyscallFilter::only_own_process(long call, bool zero_too) {
  jump(BPF_JEQ, static_cast<unsigned>(call), 0, 5);
  statement(BPF_LD | BPF_W | BPF_ABS, first_argument);
  places_.push_back(program_.size());
  jump(BPF_JEQ, 0, 2, 0);
  // 0 means the caller or its own group; where it does not, this compares with the process again.
  if (!zero_too) places_.push_back(program_.size());
  jump(BPF_JEQ, 0, 1, 0);
  statement(BPF_RET | BPF_K, refusal);
  statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
}

SyscallFilter::SyscallFilter(bool own_process_only) {
  statement(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch));
  jump(BPF_JEQ, architecture, 1, 0);
  statement(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS);
  statement(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr));
#if defined(__x86_64__)
  jump(BPF_JGE, 0x40000000, 0, 1);  // x32: the same calls with other numbers
  statement(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS);
#endif
  for (const long call : denied)
    deny(call);
  // clone3 has its flags where a filter cannot look: without it, the C library uses clone.
  refuse(435, ENOSYS);
  // Allocates gigabytes in one call, and beyond a file's end no size limit counts them. Without it,
  // the C library's posix_fallocate() writes.
  refuse(SYS_fallocate, EOPNOTSUPP);
  jump(BPF_JEQ, SYS_clone, 0, 4);
  statement(BPF_LD | BPF_W | BPF_ABS, first_argument);
  jump(BPF_JSET, new_namespaces, 0, 1);
  statement(BPF_RET | BPF_K, refusal);
  statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  for (const long call : denied_on_our_disk)
    deny(call);
  deny_emptying(SYS_openat, third_argument);
#if defined(__x86_64__)
  deny_emptying(SYS_open, second_argument);
#endif
  deny_commands(SYS_fcntl, denied_fcntl);
  deny_commands(SYS_ioctl, denied_ioctl);
  if (own_process_only) {
    for (const long call : {SYS_kill, SYS_prlimit64, SYS_sched_setaffinity, SYS_sched_setscheduler,
                            SYS_sched_setparam, SYS_sched_setattr})
      only_own_process(call, true);
    for (const long call : {SYS_tkill, SYS_tgkill, SYS_rt_sigqueueinfo, SYS_rt_tgsigqueueinfo})
      only_own_process(call, false);
  }
  statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
}

void SyscallFilter::limit_to(int process) {
  for (const std::size_t place : places_)
    program_[place].k = static_cast<unsigned>(process);
}

bool SyscallFilter::install() const {
  const sock_fprog filter{static_cast<unsigned short>(program_.size()),
                          const_cast<sock_filter*>(program_.data())};
  return ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter, 0, 0) == 0;
}

}  // namespace carlo::grader

#else

namespace carlo::grader {

SyscallFilter::SyscallFilter(bool) {}
void SyscallFilter::limit_to(int) {}
bool SyscallFilter::install() const {
  return false;
}

}  // namespace carlo::grader

#endif
