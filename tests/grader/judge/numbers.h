#pragma once

// How reports format numbers.

#include <string>

namespace carlo::grader {

/// Formats an integer in full, with gaps from five digits on as in tables ("4096", "16 384"); any
/// other number to `digits` significant digits. Accepts anything that a program may send: "NaN",
/// "inf".
std::string number_in_report(double x, int digits = 6);

/// Formats a count of things: "1 hit", "785 hits".
std::string counted(double count, const std::string& thing);

}  // namespace carlo::grader
