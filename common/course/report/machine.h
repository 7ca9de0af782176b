#pragma once

#include <string>

namespace carlo {

/// Returns the processor and how many threads it runs, e.g. "AMD EPYC 9354, 2 threads".
std::string machine_text();

/// Returns the vector instructions that the processor has and our kernels use: "SSE4.2, AVX2,
/// AVX-512".
std::string instruction_sets_text();

/// Returns the compiler and whether it optimised, e.g. "GCC 12.2.0, optimised".
std::string compiler_text();

}  // namespace carlo
