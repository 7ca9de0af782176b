#pragma once

#include <cstddef>
#include <string>

namespace carlo::grader {

/// Whether what a compiler, assembler or linker said when it failed tells of the machine: no disk,
/// memory or process was left, or it was killed. Then nothing is proven of what it read.
///
/// Lines behind a place ("a.cpp:3:1: error: ...") and lines that begin with a blank quote the file;
/// words in them do not count. A file may still make other lines: it has no marks then, and no 0.
/// What takes more than half of the `memory_limit` that we set (`peak_bytes`), or asks for a
/// quarter of it at once, has itself to blame.
bool tells_of_the_machine(const std::string& said, std::size_t peak_bytes,
                          std::size_t memory_limit);

}  // namespace carlo::grader
