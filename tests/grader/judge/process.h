#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace carlo::grader {

/// What a process that we do not trust may use.
struct Limits {
  std::chrono::milliseconds deadline{10'000};  ///< wall clock, from start to the last byte
  std::size_t memory_bytes = std::size_t{2} << 30;
  std::size_t file_bytes = std::size_t{16} << 20;
  std::size_t open_files = 64;
  std::size_t result_bytes = std::size_t{64} << 20;
  std::size_t output_bytes = std::size_t{4} << 20;  ///< printed; of it `output_kept` is kept
  std::size_t output_kept = std::size_t{8} << 10;
};

/// How it ended. The first thing that went wrong counts.
struct Outcome {
  enum class End { exited, signalled, deadline, flooded_output, flooded_result, not_started };
  End end = End::not_started;
  int code = 0;        ///< the exit code or the signal
  std::string result;  ///< what came over descriptor 3
  std::string output;  ///< the start of what it printed on stdout and stderr
};

/// Runs argv[0] (a path) with descriptor 0 from /dev/null, 1 and 2 captured, 3 the result's pipe
/// and no other, an empty environment but for `environment`, in its own session, within `limits`.
/// Returns when it and every process that it left behind are gone.
Outcome run_limited(const std::vector<std::string>& argv,
                    const std::vector<std::string>& environment, const Limits& limits);

/// "segmentation fault" for SIGSEGV; "signal 63" for one without a common name.
std::string signal_name(int signal);

/// Whether this build runs under AddressSanitizer, which needs terabytes of address space.
bool address_sanitizer();

}  // namespace carlo::grader
