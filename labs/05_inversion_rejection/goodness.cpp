#include "goodness.h"

#include <cmath>
#include <vector>

namespace lab05 {

Goodness goodness(std::span<const std::int64_t> counts, std::span<const double> probabilities,
                  std::int64_t n) {
  const auto total = static_cast<double>(n);
  std::vector<double> found, expected;
  double missing = total;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto count = static_cast<double>(counts[i]);
    if (!(probabilities[i] > 0) && count > 0) return carlo::no_fit();
    missing -= count;
    found.push_back(count);
    expected.push_back(probabilities[i] * total);
  }
  return missing != 0 ? carlo::no_fit() : carlo::pooled_goodness(found, expected);
}

double integral_over_cell(const std::function<double(double)>& pdf, double a, double b) {
  // Gauss-Legendre, three points: exact for polynomials of degree 5.
  constexpr int pieces = 8;
  const double h = (b - a) / pieces, offset = std::sqrt(0.6) * h / 2;
  double sum = 0;
  for (int i = 0; i < pieces; ++i) {
    const double centre = a + (i + 0.5) * h;
    sum += 8 * pdf(centre) + 5 * (pdf(centre - offset) + pdf(centre + offset));
  }
  return sum * h / 18;
}

}  // namespace lab05
