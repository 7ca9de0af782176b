#pragma once

#include "grader/judge/sandbox.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// A lab's worker program, in a sandbox where it sees only the system's libraries and itself.
class Worker {
 public:
  /// Uses the strongest sandbox that works here. Throws Error if the program cannot be run.
  explicit Worker(const std::filesystem::path& program);
  /// Uses this level. Throws Error, also if the level does not work here.
  Worker(const std::filesystem::path& program, Level level);
  /// Uses a sandbox that is known to work.
  Worker(const std::filesystem::path& program, Sandbox sandbox);

  const Sandbox& sandbox() const { return sandbox_; }
  Outcome run(const std::vector<std::string>& arguments, const Limits& limits) const;

 private:
  std::filesystem::path program_;
  Sandbox sandbox_;
};

}  // namespace carlo::grader
