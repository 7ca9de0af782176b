#pragma once

#include "course/guide/exercises.h"

#include <string>
#include <vector>

namespace carlo::grader {

/// A test case's name and tags in the framework.
struct TestName {
  std::string name;
  std::vector<std::string> tags;  ///< without brackets
};

/// Returns a lab's inconsistencies, one line each: every exercise of lab.json has its tag in the
/// stub and in the handout, at least one test case "TAG: sentence" tagged [labNN] and [exK], and at
/// least two hints; and none of them mentions an exercise of this lab that does not exist.
std::vector<std::string> disagreements(const Lab& lab, const std::string& stub,
                                       const std::string& handout,
                                       const std::vector<TestName>& tests);

}  // namespace carlo::grader
