#pragma once

#include "integration.h"

#include <cstddef>
#include <string>

namespace lab01 {

/// An integrand on [a, b] whose integral is known.
struct Integrand {
  std::string name;
  Function f;
  double a = 0, b = 1;
  double integral = 0;
};

/// e^x on [0, 1]: perfectly smooth. Its variance under uniform sampling is .242.
Integrand exponential();
/// 1/x on [1, 3]: smooth, and not on the unit interval.
Integrand reciprocal();
/// 1 below `edge`, 0 above, on [0, 1]: a shadow's edge.
Integrand jump(double edge);
/// x^-power on [0, 1], 0 < power < 1: infinite at 0, yet with a finite integral. Its variance is
/// finite only for power < 1/2.
Integrand singular(double power);
/// 1 everywhere on [0, 1], plus 1/width on an interval of that width that starts at `left`: half of
/// the integral sits where a uniform point falls with probability `width`, like a small bright
/// light. 0 <= left <= 1 - width.
Integrand spike(double width, double left);

/// exp(x_1 + ... + x_d) on the unit cube; its integral is (e - 1)^d.
double exponential_nd(std::span<const double> x);
double exponential_nd_integral(std::size_t dimension);

/// The unit ball in d dimensions: |x| <= 1, and its volume.
bool inside_unit_ball(std::span<const double> x);
double unit_ball_volume(std::size_t dimension);

}  // namespace lab01
