#pragma once

#include "grader/grade/judging.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// The settings for grading a class, as the caller specifies them.
struct Settings {
  std::filesystem::path tree, build, out;
  std::vector<int> labs = {};    ///< empty: all
  std::string secret_file = {};  ///< empty: $CARLO_SECRET, else OUT/secret, created once
  std::string sandbox = "auto";  ///< or the name of a level
  double deadline = 10;          ///< seconds per probe
};

/// Returns the secret from which seeds follow. Throws Error if it is empty.
std::string secret_of(const Settings& settings);

/// Returns the requested sandbox, for a build's workers and the clean tree. Throws Error if it does
/// not work here, or if submissions would have root's rights.
Sandbox sandbox_of(const Settings& settings, const CleanTree& clean);

/// Returns the course for these settings, with its digest.
Course course_of(const Settings& settings, const std::vector<CourseLab>& labs,
                 const CleanTree& clean, const Sandbox& sandbox);

}  // namespace carlo::grader
