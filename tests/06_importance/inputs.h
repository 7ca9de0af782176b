#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

// The inputs of lab 6's probes, which the checks use too.

namespace lab06_tests {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double last_below_one = 0x1.fffffffffffffp-1;

/// Numbers u in increasing order: both ends of [0, 1), tiny ones, and 99 in between.
inline std::vector<double> hard_numbers() {
  std::vector<double> u = {0, 1e-300, 1e-100, 1e-18, 0x1p-53, 1e-12, 1e-6};
  for (int i = 1; i < 100; ++i)
    u.push_back(i / 100.0);
  for (const double x : {1 - 1e-6, 1 - 1e-12, last_below_one})
    u.push_back(x);
  return u;
}

/// Lab 6.1: the values of f and the pdf at a point. Infinities and NaN cannot be passed as
/// parameters.
struct Answers {
  double f, pdf;
};
inline std::vector<Answers> answers() {
  return {{2, 4},       {-3, 2},           {1e-300, 1e-300},  {1, infinity}, {0, 0},
          {3, 0},       {infinity, 0},     {not_a_number, 1}, {0, 1e-310},   {1, -0.5},
          {0, -1e-300}, {1, not_a_number}, {0, not_a_number}};
}
constexpr std::size_t proper_answers = 9;  ///< the others are not densities

/// Labs 6.2 and 6.4: lists of contributions.
enum class List {
  mixed = 0,   ///< eight numbers of mean 5
  one = 1,     ///< a single number
  far = 2,     ///< 1000 numbers 1e8 + 1 and 1e8 - 1
  equal = 3,   ///< all the same
  zeros = 4,   ///< only zeros
  tail = 5,    ///< powers of 2, half of them negative, unsorted
  sparse = 6,  ///< three numbers among zeros
  tenths = 7,  ///< a million times 0.1
  count = 8
};

inline std::vector<double> list_of(List list) {
  switch (list) {
    case List::mixed:
      return {2, 4, 4, 4, 5, 5, 7, 9};
    case List::one:
      return {-3};
    case List::far: {
      std::vector<double> values(1000, 1e8 - 1);
      for (std::size_t i = 0; i < values.size(); i += 2)
        values[i] = 1e8 + 1;
      return values;
    }
    case List::equal:
      return std::vector<double>(10, 2.5);
    case List::zeros:
      return std::vector<double>(6, 0.0);
    case List::tail:
      return {1, -64, 4, 256, -2, 16, -32, 8, 128, -0.5};
    case List::sparse:
      return {0, 0, 8, 0, -2, 0, 4, 0};
    case List::tenths:
    case List::count:
      break;
  }
  return std::vector<double>(1'000'000, 0.1);
}

/// Lab 6.3: a light's height and the segment of the ray.
struct Light {
  double height, a, b;
};
inline const std::array<Light, 6>& lights() {
  static const std::array<Light, 6> all = {
      {{1, 0, 1}, {0.5, -1, 2}, {2, 1, 4}, {1e-3, -1, 3}, {50, -3, -2}, {0.25, -6, -0.5}}};
  return all;
}

/// Labs 6.4 and 6.7: probabilities of the first of two. For the last of them (u - share) / (1 -
/// share) is rounded to 1 at the last u below 1.
inline const std::array<double, 5>& shares() {
  static const std::array<double, 5> all = {0.5, 0.25, 0.7, 0.01, 0.25 + 3 * 0x1p-54};
  return all;
}

/// Numbers u for a share: hard_numbers() and both sides of the share.
inline std::vector<double> numbers_for(double share) {
  std::vector<double> u = hard_numbers();
  u.push_back(std::nextafter(share, 0.0));
  u.push_back(share);
  return u;
}

/// Lab 6.4: pdfs of two densities to be mixed. They need not be real densities: only values are
/// compared.
inline double positive_pdf(double x) {
  return x >= 0 ? 2 * x : 0.25;
}
inline double negative_pdf(double x) {
  return x >= 0 ? 0.5 + x * x : 0;
}

/// Lab 6.5: f and g on [a, b) under a bound that is higher than necessary; and a g that is 0 on
/// half of [0, 1).
enum class Profile { parabola = 0, step = 1 };
struct Dartboard {
  double a, b, g_max;
};
inline Dartboard dartboard(Profile profile) {
  return profile == Profile::parabola ? Dartboard{-1, 2, 6} : Dartboard{0, 1, 2};
}
inline double profile_g(Profile profile, double x) {
  if (profile == Profile::parabola) return 1 + x * x;
  return x < 0.5 ? 0 : 1.5;
}
inline double profile_f(Profile profile, double x) {
  return profile == Profile::parabola ? x * x + 2 : 3 + x;
}

/// Lab 6.6: pairs of efforts.
struct Pair {
  double samples, pdf, other_samples, other_pdf;
};
inline std::vector<Pair> pairs() {
  return {{1, 1, 1, 1},
          {1, 1, 1, 3},
          {3, 1, 1, 1},
          {4, 0.5, 1, 2},
          {2, 0.5, 5, 0.1},
          {0.3, 2, 0.7, 0.5},
          {0.25, 1e-3, 0.75, 1e3},
          // One technique cannot have drawn the point, or has no samples.
          {1, 2, 1, 0},
          {3, 2, 0, 5},
          {0, 5, 0, 5},
          {1, 0, 1, 0},
          {0, 0, 3, 0},
          // Lights that are almost points.
          {1, 1e30, 1, 1},
          {16, 1e30, 1, 1e30},
          {1, 1e20, 1, 3e20},
          // Squares, sums and products outside the range of double.
          {1, 1e200, 1, 1e200},
          {1, 1e200, 1, 3e200},
          {2, 1e-200, 1, 3e-200},
          {1, 1e308, 1, 1.5e308},
          {16, 1e308, 64, 1e308},
          {16, 1e-308, 64, 3e-308},
          {1, 1e-300, 1, 1e300},
          {1, infinity, 1, 1},
          {4, infinity, 2, 0},
          {1, infinity, 0, 3}};
}

}  // namespace lab06_tests
