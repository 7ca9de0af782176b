#pragma once

namespace carlo::grader {

/// From now on a crash because this thread's stack is full first says so on stderr, with the
/// stack's size (protocol/frame.h): the signal alone is that of any bad access. Call it on
/// the main thread. Does nothing where the stack has no limit, and in a sanitizer build, which
/// reports it itself.
void report_full_stack();

}  // namespace carlo::grader
