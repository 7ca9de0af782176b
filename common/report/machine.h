#pragma once

#include <string>

namespace carlo {

/// The processor and how many threads it runs, e.g. "AMD EPYC 9354, 2 threads".
std::string machine_text();

/// The compiler and whether it optimised, e.g. "GCC 12.2.0, optimised".
std::string compiler_text();

}  // namespace carlo
