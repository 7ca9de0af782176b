// What a fit says once it is made; making one (fit.cpp) takes more.

#include "stats/fit.h"

#include <cmath>
#include <limits>

namespace carlo {

double PowerFit::at(double x) const {
  return std::exp(log_scale + slope * std::log(x));
}

double PowerFit::band_factor(double x) const {
  return std::exp(std::hypot(mean_half_width, slope_half_width * (std::log(x) - mean_log_x)));
}

double crossing(const PowerFit& a, const PowerFit& b) {
  if (a.slope == b.slope) return std::numeric_limits<double>::infinity();
  return std::exp((b.log_scale - a.log_scale) / (a.slope - b.slope));
}

}  // namespace carlo
