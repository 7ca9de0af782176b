#pragma once

#include "course/cli/descriptor.h"

#include <filesystem>

namespace carlo::grader {

/// Returns the kernel's version of Landlock; 0: none. At most the environment's
/// CARLO_LANDLOCK_VERSION, for tests of older versions.
int landlock_version();

/// The rules for what one process may open. Paths are not hidden (stat() still answers), but
/// nothing outside the rules can be read, run or changed. Make rules before fork(); they use the
/// maker's rights.
class LandlockRules {
 public:
  /// Throws Error if the kernel has no Landlock.
  LandlockRules();

  /// Allows files and folders to be read and run; skips those that do not exist.
  void allow_reading(const std::filesystem::path& path);
  /// Allows everything in a folder except running its files.
  void allow_writing(const std::filesystem::path& folder);
  /// Allows a device such as /dev/null.
  void allow_device(const std::filesystem::path& device);

  int descriptor() const { return rules_.get(); }

 private:
  void allow(const std::filesystem::path& path, unsigned long long rights);

  Descriptor rules_;
};

/// Applies the rules to the calling process and all that it starts. Returns false if the kernel
/// refuses. Safe between fork and exec.
bool restrict_to_landlock_rules(int descriptor);

}  // namespace carlo::grader
