#include "goodness.h"

#include "stats/distributions.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

namespace lab05 {

Goodness goodness(std::span<const std::int64_t> counts, std::span<const double> probabilities,
                  std::int64_t n) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto total = static_cast<double>(n);
  std::vector<double> found, expected;
  double pending_found = 0, pending = 0, missing = total;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto count = static_cast<double>(counts[i]);
    if (!(probabilities[i] > 0) && count > 0) return {infinity, 0, 0};
    missing -= count;
    pending_found += count;
    pending += probabilities[i] * total;
    if (pending < 100) continue;
    found.push_back(pending_found);
    expected.push_back(pending);
    pending_found = pending = 0;
  }
  if (missing != 0 || found.size() < 2) return {infinity, 0, 0};
  found.back() += pending_found;
  expected.back() += pending;
  Goodness result;
  for (std::size_t i = 0; i < found.size(); ++i)
    result.statistic += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
  result.freedom = static_cast<double>(found.size() - 1);
  result.p = carlo::chi_square_upper(result.statistic, result.freedom);
  return result;
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

double seconds_a_draw(std::int64_t count, const std::function<double()>& round) {
  using Clock = std::chrono::steady_clock;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const auto start = Clock::now();
    volatile double sink = round();
    (void)sink;
    best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return best / static_cast<double>(count);
}

}  // namespace lab05
