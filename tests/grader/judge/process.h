#pragma once

#include "grader/judge/syscall_filter.h"

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace carlo::grader {

/// A child's confinement of itself between fork and exec, besides limits, its own session and no
/// new privileges. Descriptors stay the caller's.
struct Confinement {
  std::string folder = {};                   ///< its working folder; empty: the caller's
  std::optional<uid_t> user = {};            ///< its user and only group, if we are root
  std::optional<SyscallFilter> filter = {};  ///< the system calls that it may not make
  int landlock_rules = -1;                   ///< rules for opening files
  int inherited = -1;                        ///< becomes its descriptor 4
  int status = -1;                           ///< becomes its descriptor 5
  bool untrusted = false;                    ///< if memory runs out, it is killed first
  std::optional<std::string> measured = {};  ///< the folder whose size is limited
};

/// The limits of an untrusted process.
struct Limits {
  /// From start to the last byte, without the time in which it was ready to run but others had the
  /// processors; including that, at most `patience` times as long. Competition among its own
  /// processes counts. Time waiting for a disk does not count, up to two deadlines.
  std::chrono::milliseconds deadline{10'000};
  std::chrono::seconds cpu{0};  ///< processor time; 0: a second more than the deadline
  std::size_t memory_bytes = std::size_t{2} << 30;     ///< of each process, and of all together
  std::size_t file_bytes = std::size_t{16} << 20;      ///< the largest file
  std::size_t scratch_bytes = std::size_t{256} << 20;  ///< all files in the scratch folder
  std::size_t open_files = 64;
  /// Including threads: simultaneous ones if the user is its own; otherwise as the watcher counts
  /// them.
  std::size_t processes = 256;
  std::size_t result_bytes = std::size_t{64} << 20;
  std::size_t output_bytes = std::size_t{4} << 20;  ///< printed; `output_kept` of it is kept
  std::size_t output_kept = std::size_t{8} << 10;
};

/// How many deadlines of wall time a program may take on a busy machine.
constexpr int patience = 8;

/// The value that means no limit.
constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

/// How busy the machine was while a program ran, as measured from outside.
struct Pressure {
  double seconds = 0;  ///< wall clock
  double held_up = 0;  ///< of these, the watcher waited for a processor
  double worked = 0;   ///< of these, the program's processes could have used all processors

  /// Returns whether others had the processors, so that seconds prove nothing: this process, which
  /// mostly sleeps, had to wait, and not because of those that it watches.
  bool is_high() const { return held_up > .1 * seconds && worked < .4 * seconds; }
  Pressure& operator+=(const Pressure& other);
};

/// How a program ended. The first thing that went wrong counts.
struct Outcome {
  enum class End {
    exited,
    signalled,
    deadline,
    starved,  ///< others had the processors: too late, perhaps through no fault of its own
    flooded_output,
    flooded_result,
    flooded_disk,
    flooded_memory,
    flooded_processes,
    not_started
  };
  End end = End::not_started;
  int code = 0;                ///< exit code or signal
  std::string result;          ///< the bytes from descriptor 3
  std::string output;          ///< the start of what it printed on stdout and stderr; or why it
                               ///< was not started
  std::size_t lost_lines = 0;  ///< lines that it printed, or began, beyond `output`
  double seconds = 0;          ///< wall clock
  /// Of these, not charged: ready to run, but others had the processors; waiting for a disk;
  /// everything stood still.
  double waited = 0;
  double ran = 0;              ///< of these, its longest-running thread had a processor
  Pressure pressure;           ///< how busy the machine was meanwhile
  std::size_t peak_bytes = 0;  ///< resident memory of the largest process, as far as reaped

  bool succeeded() const { return end == End::exited && code == 0; }
};

/// A program to run: argv[0] is its path.
struct Command {
  std::vector<std::string> argv;
  std::vector<std::string> environment;
  Confinement confinement = {};
};

/// Runs a program with descriptor 0 from /dev/null, 1 and 2 captured, 3 the result's pipe and no
/// other, only the given environment, in its own session, within `limits`; it ends with the calling
/// thread. Returns when it and every process that it left behind are gone. The caller must not have
/// other children that it wants to keep.
Outcome run_limited(const Command& command, const Limits& limits);

/// Returns "segmentation fault" for SIGSEGV; "signal 63" for a signal without a common name.
std::string signal_name(int signal);

/// Returns whether this build runs under AddressSanitizer, which needs terabytes of address space.
bool address_sanitizer();

}  // namespace carlo::grader
