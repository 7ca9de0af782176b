#include "bias.h"

#include <cmath>

// Lab 09, step f: ever smaller discs. Solved.

namespace lab09 {

// Lab 9.6 -----------------------------------------------------------------------------------------

double next_radius(double radius, int pass, double alpha) {
  const double i = pass;
  return radius * std::sqrt((i + alpha) / (i + 1));
}

Rgb progressive_mean(int passes, double first_radius, double alpha,
                     const std::function<Rgb(int pass, double radius)>& estimate) {
  glm::dvec3 sum(0);
  double radius = first_radius;
  for (int pass = 1; pass <= passes; ++pass) {
    sum += estimate(pass, radius);
    radius = next_radius(radius, pass, alpha);
  }
  return sum / static_cast<double>(passes);
}

}  // namespace lab09
