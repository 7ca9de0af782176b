#pragma once

#include "course/cli/descriptor.h"

#include <filesystem>

namespace carlo::grader {

/// Which version of Landlock the kernel has; 0: none. At most the environment's
/// CARLO_LANDLOCK_VERSION, for tests of what holds on older kernels.
int landlock_version();

/// The rules for one process: what it may open. Paths are not hidden (stat() still answers), but
/// nothing outside of the rules can be read, run or changed. Rules are made before fork(), with the
/// rights of the one who makes them.
class LandlockRules {
 public:
  /// Throws Error where the kernel has no Landlock.
  LandlockRules();

  /// Files and folders that may be read and run; those that do not exist are passed over.
  void allow_reading(const std::filesystem::path& path);
  /// A folder in which everything may be done but running what stands in it.
  void allow_writing(const std::filesystem::path& folder);
  /// A device such as /dev/null.
  void allow_device(const std::filesystem::path& device);

  int descriptor() const { return rules_.get(); }

 private:
  void allow(const std::filesystem::path& path, unsigned long long rights);

  Descriptor rules_;
};

/// Puts the calling process, and all that it starts, under the rules. False when the kernel
/// refuses. Safe between fork and exec.
bool restrict_to_landlock_rules(int descriptor);

}  // namespace carlo::grader
