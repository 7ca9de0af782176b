#pragma once

// Mistakes that several exercises share.

#include "grader/judge/suspect.h"

#include <limits>

namespace lab01_tests {

inline const carlo::grader::Diagnosis whole_division{
    "whole-number-division",
    "a quotient of two whole numbers is a whole number, so 1/n is 0 from n = 2 on."};

/// The value of a mean or an integral that was multiplied by such a quotient. For n = 1 it is
/// right: a wrong value there has another cause.
inline carlo::grader::Suspect of_whole_division(double n) {
  return {n > 1 ? 0 : std::numeric_limits<double>::quiet_NaN(), whole_division};
}

inline const carlo::grader::Diagnosis sum_of_sides{
    "sum-of-sides", "the box's volume is taken as the sum of its sides; it is their product."};

inline const carlo::grader::Diagnosis same_number{
    "same-number-in-every-dimension",
    "all coordinates of a point come from one random number: the points lie on the diagonal."};

/// The results if `mean` is multiplied by a sum of sides instead of the box's volume, for sums that
/// begin with 0 and with 1. With a single side the sum is right.
inline void add_sums_of_sides(carlo::grader::Suspects& suspects, double mean, double sides, int d) {
  if (d > 1) suspects.push_back({mean * sides, sum_of_sides});
  suspects.push_back({mean * (1 + sides), sum_of_sides});
}

}  // namespace lab01_tests
