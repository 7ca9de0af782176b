#pragma once

// Mistakes that several exercises share: the position x in stratum i of n that they lead to.

#include "grader/judge/suspect.h"

namespace lab04_tests {

inline const carlo::grader::Diagnosis one_part_divided{
    "one-part-divided",
    "only one of the stratum's number and the position within it is divided by n: check the "
    "parentheses."};

/// True if x is i + u/n for a u in [0, 1).
inline bool is_share_divided_alone(double x, double i, double n) {
  return x - i >= 0 && (x - i) * n < 1;
}

/// True if x is i/n + u for a u in [0, 1). Much else may be, too: it takes many positions, some of
/// them outside [0, 1).
inline bool is_number_divided_alone(double x, double i, double n) {
  return x - i / n >= 0 && x - i / n < 1;
}

}  // namespace lab04_tests
