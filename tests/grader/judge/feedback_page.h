#pragma once

#include "course/verdict/verdict.h"

#include <string>

namespace carlo::grader {

/// Where the page of a run goes; empty names write none.
struct PageFiles {
  std::string always;
  std::string on_failure;  ///< only when something has failed, or an older run's page stands there
};

/// Writes the page of a lab's verdicts, making its folder, and says where it is. Throws Error.
void write_feedback_page(const LabResult& lab, const PageFiles& files);

}  // namespace carlo::grader
