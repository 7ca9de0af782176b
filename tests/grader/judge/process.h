#pragma once

#include "grader/judge/confinement.h"

#include <chrono>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace carlo::grader {

/// What a process that we do not trust may use.
struct Limits {
  /// From start to the last byte, without the time for which it was ready to run but others had the
  /// processors; with it at most `patience` times as long. What its own processes take from one
  /// another counts. Of the time for which it waits for a disk, up to two deadlines do not count.
  std::chrono::milliseconds deadline{10'000};
  std::chrono::seconds cpu{0};  ///< processor time; 0: a second over the deadline
  std::size_t memory_bytes = std::size_t{2} << 30;     ///< of each process, and of all together
  std::size_t file_bytes = std::size_t{16} << 20;      ///< the largest file
  std::size_t scratch_bytes = std::size_t{256} << 20;  ///< all files in the scratch folder
  std::size_t open_files = 64;
  /// And threads: as many at a time where the user is its own; elsewhere as seen by who watches.
  std::size_t processes = 256;
  std::size_t result_bytes = std::size_t{64} << 20;
  std::size_t output_bytes = std::size_t{4} << 20;  ///< printed; of it `output_kept` is kept
  std::size_t output_kept = std::size_t{8} << 10;
};

/// How many deadlines of wall clock a program may take on a busy machine.
constexpr int patience = 8;

/// The value of a limit that is none.
constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

/// How busy the machine was while a program ran, by what we can measure from outside.
struct Pressure {
  double seconds = 0;  ///< wall clock
  double held_up = 0;  ///< of these the one who watches was kept from a processor
  double worked = 0;   ///< of these the program's processes could have worked all processors

  /// Whether others had the processors, so that seconds prove nothing: we ourselves, who mostly
  /// sleep, had to wait, and not for those whom we watch.
  bool is_high() const { return held_up > .1 * seconds && worked < .4 * seconds; }
  Pressure& operator+=(const Pressure& other);
};

/// How it ended. The first thing that went wrong counts.
struct Outcome {
  enum class End {
    exited,
    signalled,
    deadline,
    starved,  ///< others had the processors: too late, and no proof that it is its own doing
    flooded_output,
    flooded_result,
    flooded_disk,
    flooded_memory,
    flooded_processes,
    not_started
  };
  End end = End::not_started;
  int code = 0;                ///< the exit code or the signal
  std::string result;          ///< what came over descriptor 3
  std::string output;          ///< the start of what it printed on stdout and stderr; why it was
                               ///< not started
  std::size_t lost_lines = 0;  ///< that it printed beyond `output`, or began to
  double seconds = 0;          ///< wall clock
  /// Of these: ready to run, but others had the processors; a disk was awaited; and all of us stood
  /// still. Not charged.
  double waited = 0;
  double ran = 0;              ///< of these the thread that ran longest had a processor
  Pressure pressure;           ///< what the machine was like meanwhile
  std::size_t peak_bytes = 0;  ///< resident memory of the largest process, as far as it was reaped

  bool succeeded() const { return end == End::exited && code == 0; }
};

/// A program to run: argv[0] is its path.
struct Command {
  std::vector<std::string> argv;
  std::vector<std::string> environment;
  Confinement confinement = {};
};

/// Runs a program with descriptor 0 from /dev/null, 1 and 2 captured, 3 the result's pipe and no
/// other, no environment but its own, in its own session, within `limits`; it ends with the thread
/// that called. Returns when it and every process that it left behind are gone. The caller has no
/// other child that it wants to keep.
Outcome run_limited(const Command& command, const Limits& limits);

/// "segmentation fault" for SIGSEGV; "signal 63" for one without a common name.
std::string signal_name(int signal);

/// Whether this build runs under AddressSanitizer, which needs terabytes of address space.
bool address_sanitizer();

}  // namespace carlo::grader
