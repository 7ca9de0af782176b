#include "plates.h"

#include <cmath>

namespace lab06 {
namespace {

double radiance(double x) {
  double sum = 0;
  for (const Light& light : plate_lights)
    sum += std::abs(x - light.centre) < light.half_width ? light.radiance() : 0;
  return sum;
}

/// The integral of the lobe from minus infinity to x.
double logistic_cdf(double x, double centre, double scale) {
  return 1 / (1 + std::exp(-(x - centre) / scale));
}

}  // namespace

Function plate_integrand(double m, double scale) {
  const Density lobe = logistic_density(m, scale);
  return [lobe](double x) {
    const double light = radiance(x);
    return light > 0 ? light * lobe.pdf(x) : 0;
  };
}

double plate_exact(double m, double scale) {
  double sum = 0;
  for (const Light& light : plate_lights) {
    const double from = light.centre - light.half_width, to = light.centre + light.half_width;
    // Uses the side of the lobe where both values are small, so that no digits are lost.
    const double part =
        from > m ? logistic_cdf(2 * m - from, m, scale) - logistic_cdf(2 * m - to, m, scale)
                 : logistic_cdf(to, m, scale) - logistic_cdf(from, m, scale);
    sum += light.radiance() * part;
  }
  return sum;
}

Density light_technique() {
  constexpr auto count = static_cast<double>(plate_lights.size());
  return {[](double u) {
            const auto i = static_cast<std::size_t>(u * count);
            const Light& light = plate_lights.at(i);
            const double place = u * count - static_cast<double>(i);
            return light.centre + (2 * place - 1) * light.half_width;
          },
          [](double x) { return radiance(x) / count; }};
}

Density lobe_technique(double m, double scale) {
  return logistic_density(m, scale);
}

}  // namespace lab06
