#pragma once

// Slips that several exercises share: what n strata make of a place x in stratum i.

#include "grader/judge/suspect.h"

namespace lab04_tests {

inline const carlo::grader::Diagnosis one_part_divided{
    "one-part-divided",
    "only one of the two, the stratum's number or the place within it, is divided by n: look at "
    "the parentheses."};

/// Whether x is i + u/n for a u in [0, 1).
inline bool is_share_divided_alone(double x, double i, double n) {
  return x - i >= 0 && (x - i) * n < 1;
}

/// Whether x is i/n + u for a u in [0, 1). So may be much else: many places tell, and some outside
/// of [0, 1).
inline bool is_number_divided_alone(double x, double i, double n) {
  return x - i / n >= 0 && x - i / n < 1;
}

}  // namespace lab04_tests
