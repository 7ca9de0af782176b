#pragma once

#include <cstddef>
#include <string>

namespace carlo::grader {

/// Returns whether the messages of a failed compiler, assembler or linker blame the machine: no
/// disk, memory or process was left, or it was killed. Then nothing is proven about its input.
///
/// Lines after a place ("a.cpp:3:1: error: ...") and lines that begin with a blank quote the file,
/// so their text does not count. A file may still provoke other lines: it then has no marks, rather
/// than 0. A compilation that takes more than half of the `memory_limit` that we set
/// (`peak_bytes`), or asks for a quarter of it at once, is itself to blame.
bool tells_of_the_machine(const std::string& said, std::size_t peak_bytes,
                          std::size_t memory_limit);

}  // namespace carlo::grader
