#pragma once

#include "grader/grade/judging.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// What a class is graded by, in the words of whoever asks for it.
struct Settings {
  std::filesystem::path tree, build, out;
  std::vector<int> labs = {};    ///< empty: all
  std::string secret_file = {};  ///< empty: $CARLO_SECRET, else OUT/secret, made once
  std::string sandbox = "auto";  ///< or the name of a level
  double deadline = 10;          ///< seconds that one probe may take
};

/// What seeds follow from. Throws Error when it is empty.
std::string secret_of(const Settings& settings);

/// The sandbox that is asked for, of a build's workers and the clean tree. Throws Error when it
/// does not work here, or when submissions would have root's rights.
Sandbox sandbox_of(const Settings& settings, const CleanTree& clean);

/// What follows from the settings, with its digest.
Course course_of(const Settings& settings, const std::vector<CourseLab>& labs,
                 const CleanTree& clean, const Sandbox& sandbox);

}  // namespace carlo::grader
