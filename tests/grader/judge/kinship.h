#pragma once

namespace carlo::grader {

// What Linux does for parents and children; elsewhere these do nothing, and a judge that is killed
// may leave the program that it judged running until its limits end it. Safe between fork and exec.

/// This process gets `signal` when its parent ends. False when the kernel refuses.
bool ends_with_parent(int signal);

/// Orphans below this process become its children. False when the kernel refuses.
bool adopts_orphans();

/// Neither this process nor what it starts gains rights by running a program. False when the kernel
/// refuses.
bool gains_no_privileges();

}  // namespace carlo::grader
