#pragma once

#include <string>

namespace carlo {

/// The processor and how many threads it runs, e.g. "AMD EPYC 9354, 2 threads".
std::string machine_text();

/// What of the processor's vector instructions our kernels know: "SSE4.2, AVX2, AVX-512".
std::string instruction_sets_text();

/// The compiler and whether it optimised, e.g. "GCC 12.2.0, optimised".
std::string compiler_text();

}  // namespace carlo
