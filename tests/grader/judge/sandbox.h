#pragma once

#include "grader/judge/process.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// How strongly a worker is shut in. `limits`: own session, resource limits, no new privileges, no
/// descriptors. `bubblewrap`: these and namespaces of its own: it sees the system's libraries and
/// itself, nothing else of the disk, no network, no other process.
enum class Level { limits, bubblewrap };

std::string to_string(Level level);

/// Runs one worker program at one level.
class Sandbox {
 public:
  /// The strongest level that works here, found by trying it on a harmless program.
  static Sandbox strongest(const std::filesystem::path& worker);

  /// Throws Error when the worker is no program that can be run.
  Sandbox(const std::filesystem::path& worker, Level level);

  Level level() const { return level_; }
  /// Runs the worker with these arguments. A death by signal is told as such at every level.
  Outcome run(const std::vector<std::string>& arguments, const Limits& limits) const;

 private:
  std::filesystem::path worker_;
  Level level_;
};

}  // namespace carlo::grader
