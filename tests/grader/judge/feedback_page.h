#pragma once

#include "course/verdict/verdict.h"

#include <string>

namespace carlo::grader {

/// The paths of a run's page; empty names write none.
struct PageFiles {
  std::string always;
  std::string on_failure;  ///< only if something has failed, or an older run's page exists
};

/// Writes the page of a lab's verdicts, creating its folder, and prints where it is. Throws Error.
void write_feedback_page(const LabResult& lab, const PageFiles& files);

}  // namespace carlo::grader
