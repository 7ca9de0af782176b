#pragma once

namespace carlo {

// The incomplete gamma functions, each with its own relative accuracy where it is small: 1e-12 for
// a up to 1e4, 1e-10 for a up to 1e7 (tests/common/gamma_test.cpp, against Boost.Math, which takes
// eight times as long to compile into everybody's first verdict). Source: NIST Digital Library of
// Mathematical Functions, 8.11.4 and 8.9.2.

/// P(a, x), the probability that a gamma variable of shape a, 0 < a <= 1e12, is at most x >= 0.
/// NaN outside.
double gamma_lower(double a, double x);

/// Q(a, x) = 1 - P(a, x).
double gamma_upper(double a, double x);

/// log(x^a e^-x / Gamma(a + 1)) for a, x > 0: for whole a the logarithm of a Poisson probability.
double log_poisson(double a, double x);

}  // namespace carlo
