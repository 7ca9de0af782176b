#pragma once

namespace carlo::grader {

// Linux's features for parents and children; elsewhere these do nothing, and a killed judge may
// leave the program that it judged running until its limits end it. Safe between fork and exec.

/// Sends this process `signal` when its parent ends. Returns false if the kernel refuses.
bool ends_with_parent(int signal);

/// Makes orphans below this process its children. Returns false if the kernel refuses.
bool adopts_orphans();

/// Prevents this process and those that it starts from gaining rights by running a program. Returns
/// false if the kernel refuses.
bool gains_no_privileges();

}  // namespace carlo::grader
