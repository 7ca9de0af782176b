#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

// The integrands of the probes, for which checks know the averages.

namespace lab04_tests {

/// x^k, k >= 0.
inline double power(double x, int k) {
  double product = 1;
  for (int i = 0; i < k; ++i)
    product *= x;
  return product;
}

/// The integrands on the unit cube with which recursive stratification is judged.
enum class CubeIntegrand {
  disc,      ///< 4 inside the quarter of the unit circle, 2D: the average is pi
  bell,      ///< exp(-|x|^2), any dimension
  peak,      ///< a narrow bell at (.25, .3), 2D
  corner,    ///< sin^2 waves in [0, 1/4)^2, else 0
  half,      ///< a fine chessboard of 0 and 2 for x < 1/2, else 0: the average is 1/2
  one_axis,  ///< exp(5 x[1]): only axis 1 matters
  constant   ///< 3
};

constexpr double peak_sharpness = 200;
constexpr double peak_at[2] = {0.25, 0.3};

inline double evaluate(CubeIntegrand kind, std::span<const double> x) {
  switch (kind) {
    case CubeIntegrand::disc:
      return x[0] * x[0] + x[1] * x[1] < 1 ? 4 : 0;
    case CubeIntegrand::bell: {
      double squares = 0;
      for (const double c : x)
        squares += c * c;
      return std::exp(-squares);
    }
    case CubeIntegrand::peak: {
      const double a = x[0] - peak_at[0], b = x[1] - peak_at[1];
      return std::exp(-peak_sharpness * (a * a + b * b));
    }
    case CubeIntegrand::corner: {
      if (x[0] >= 0.25 || x[1] >= 0.25) return 0;
      const double waves =
          std::sin(16 * std::numbers::pi * x[0]) * std::sin(16 * std::numbers::pi * x[1]);
      return waves * waves;
    }
    case CubeIntegrand::half:
      if (x[0] >= 0.5) return 0;
      return (static_cast<int>(x[0] * 4096) + static_cast<int>(x[1] * 4096)) % 2 == 0 ? 2 : 0;
    case CubeIntegrand::one_axis:
      return std::exp(5 * x[1]);
    case CubeIntegrand::constant:
      break;
  }
  return 3;
}

}  // namespace lab04_tests
