#include "point_sets.h"

#include "sampling/halton.h"
#include "sampling/sobol.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace lab04 {
namespace {

std::vector<Point> random_points(std::int64_t n, carlo::Rng& rng) {
  std::vector<Point> points(static_cast<std::size_t>(n));
  for (Point& p : points) {
    p.x = rng.uniform();
    p.y = rng.uniform();
  }
  return points;
}

std::vector<Point> jittered_points(std::int64_t n, carlo::Rng& rng) {
  const auto side = static_cast<std::int64_t>(std::lround(std::sqrt(static_cast<double>(n))));
  return jittered(side, side, rng);
}

std::vector<Point> latin_points(std::int64_t n, carlo::Rng& rng) {
  const std::vector<double> coordinates = latin_hypercube(n, 2, rng);
  std::vector<Point> points;
  points.reserve(coordinates.size() / 2);
  for (std::size_t i = 0; i + 1 < coordinates.size(); i += 2)
    points.push_back({coordinates[i], coordinates[i + 1]});
  return points;
}

std::vector<Point> halton_points(std::int64_t n, carlo::Rng& rng) {
  const double shift_x = rng.uniform();
  const double shift_y = rng.uniform();
  std::vector<Point> points;
  points.reserve(static_cast<std::size_t>(n));
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(n); ++i) {
    points.push_back({carlo::rotated(carlo::halton(i, 0), shift_x),
                      carlo::rotated(carlo::halton(i, 1), shift_y)});
  }
  return points;
}

/// All 32 bits: with a float's 24 the positions would be too coarse for the smallest errors.
double fraction(std::uint32_t word) {
  return static_cast<double>(word) * 0x1p-32;
}

std::vector<Point> sobol_points(std::int64_t n, carlo::Rng& rng) {
  const std::uint32_t seed_x = rng.next_u32();
  const std::uint32_t seed_y = rng.next_u32();
  std::vector<Point> points;
  points.reserve(static_cast<std::size_t>(n));
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
    points.push_back({fraction(carlo::owen_scramble(carlo::reverse_bits(i), seed_x)),
                      fraction(carlo::owen_scramble(carlo::sobol_second(i), seed_y))});
  }
  return points;
}

/// The integral of exp(-sharpness (x - c)^2) over [0, 1].
double bell_1d(double sharpness, double c) {
  const double root = std::sqrt(sharpness);
  return std::sqrt(std::numbers::pi) / (2 * root) * (std::erf(root * (1 - c)) + std::erf(root * c));
}

}  // namespace

// Over N = 16 ... 65 536 a factor of (log N)^(1/2) adds .08 to a slope. Mean squares have this
// factor in two dimensions: at least for any points (Roth, "On irregularities of distribution",
// 1954), and exactly for scrambled nets (Owen, "Scrambled net variance for integrals of smooth
// functions", 1997).
std::vector<PointSet> all_point_sets() {
  return {{"random", random_points, "-1/2", "-1/2"},
          {"jittered", jittered_points, "-1", "-3/4"},
          {"Latin hypercube", latin_points, "-1/2", "-1/2"},
          {"Halton + shift", halton_points, "-1, √log N makes it -.92", "-3/4"},
          {"Sobol', scrambled", sobol_points, "-3/2, √log N makes it -1.42", "-3/4"}};
}

Integrand bell() {
  return {"exp(-x² - y²)", [](double x, double y) { return std::exp(-x * x - y * y); },
          bell_1d(1, 0) * bell_1d(1, 0)};
}

Integrand darts() {
  return {"π by darts", [](double x, double y) { return x * x + y * y < 1 ? 4.0 : 0.0; },
          std::numbers::pi};
}

Integrand peak() {
  const auto f = [](double x, double y) {
    const double dx = x - peak_x, dy = y - peak_y;
    return std::exp(-peak_sharpness * (dx * dx + dy * dy));
  };
  return {"a narrow peak", f, bell_1d(peak_sharpness, peak_x) * bell_1d(peak_sharpness, peak_y)};
}

double average_over(const std::vector<Point>& points, const Integrand& integrand) {
  double sum = 0;
  for (const Point& p : points)
    sum += integrand.f(p.x, p.y);
  return sum / static_cast<double>(points.size());
}

}  // namespace lab04
