#pragma once

#include "grader/calibrate/plan.h"
#include "grader/calibrate/record.h"

#include <functional>
#include <vector>

namespace carlo::grader {

/// Runs the judges of all jobs, `at_once` at a time and at the lowest priority, and passes on each
/// record as soon as it is complete. Throws Error if a judge gives no verdicts, or if a program was
/// rebuilt meanwhile; running judges are ended then.
void run_jobs(const std::vector<Job>& jobs, int at_once,
              const std::function<void(const Record&)>& done);

}  // namespace carlo::grader
