#pragma once

// The integrands and domains of the probes, for which checks know the exact answers.

#include <cmath>
#include <cstddef>
#include <span>

namespace lab01_tests {

/// x^k; its moments on any interval are closed forms (theory.h).
inline double power(double x, int k) {
  return std::pow(x, k);
}

/// Side i of the test box: [0.5 + i / 4, 1.75 + i / 2): no two sides agree, and none is 1.
inline double lower(std::size_t i) {
  return 0.5 + 0.25 * static_cast<double>(i);
}
inline double upper(std::size_t i) {
  return 1.75 + 0.5 * static_cast<double>(i);
}

/// Integrands on the box: the product of the coordinates, which is linear in each of them; and the
/// sum of (i + 1) x_i^2, which distinguishes the dimensions.
enum class BoxIntegrand { product, squares };

inline double evaluate(BoxIntegrand kind, std::span<const double> x) {
  double product = 1, squares = 0, weight = 1;
  for (const double coordinate : x) {
    product *= coordinate;
    squares += weight * coordinate * coordinate;
    weight += 1;
  }
  return kind == BoxIntegrand::product ? product : squares;
}

/// Domains within the box [-1, 1.5) x [-1.25, 1) ( x [-1, 1) ): the unit ball, nothing, everything.
enum class Domain { ball, nothing, everything };

constexpr double domain_lower[] = {-1, -1.25, -1};
constexpr double domain_upper[] = {1.5, 1, 1};

inline bool contains(Domain domain, std::span<const double> x) {
  double squares = 0;
  for (const double coordinate : x)
    squares += coordinate * coordinate;
  return domain == Domain::everything || (domain == Domain::ball && squares < 1);
}

/// Integrands on the domain: 1, 2 + x and x^2, where x is the first coordinate.
enum class DomainIntegrand { one, tilted, square };

inline double evaluate(DomainIntegrand kind, std::span<const double> x) {
  if (kind == DomainIntegrand::one) return 1;
  return kind == DomainIntegrand::tilted ? 2 + x[0] : x[0] * x[0];
}

}  // namespace lab01_tests
