#pragma once

#include <string>

namespace carlo::grader {

/// What a machine compiles and runs students' code with, in a line: compiler, linker, C library and
/// kind of processor. Two machines of the same line come to the same marks. Throws Error where
/// there is no such compiler.
std::string toolchain_of(const std::string& compiler);

}  // namespace carlo::grader
