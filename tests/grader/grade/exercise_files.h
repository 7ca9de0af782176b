#pragma once

#include "course/guide/exercises.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// One lab of the course and the files that students write: nothing else in a submission is ever
/// compiled.
struct CourseLab {
  Lab lab;
  std::string folder;              ///< "01_integration"
  std::vector<std::string> files;  ///< "integration.cpp", or "steps/a_camera.cpp" and so on

  /// "01"
  std::string number() const { return folder.substr(0, 2); }
};

/// Returns the labs below `labs`, in order; `only` (numbers) selects some unless it is empty.
/// Throws Error if one of these does not exist, or a lab has no file for students.
std::vector<CourseLab> course_labs(const std::filesystem::path& labs, const std::vector<int>& only);

/// Returns the last part of a path: "a_camera.cpp" of "steps/a_camera.cpp".
std::string last_part(const std::string& path);

}  // namespace carlo::grader
