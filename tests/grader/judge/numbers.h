#pragma once

// How reports write numbers.

#include <string>

namespace carlo::grader {

/// A whole number in full, with gaps from five digits on as tables have them ("4096", "16 384");
/// another one to `digits` significant digits. Whatever a program sent: "NaN", "inf".
std::string number_in_report(double x, int digits = 6);

/// So many things: "1 hit", "785 hits".
std::string counted(double count, const std::string& thing);

}  // namespace carlo::grader
