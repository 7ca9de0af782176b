#pragma GCC diagnostic ignored "-Wunused-parameter"  // until it is solved
#include "bias.h"
#include "course/not_implemented.h"

// Lab 09, step a: bias and noise apart. bias.h says what each function takes and returns.

namespace lab09 {

// Lab 9.1 -----------------------------------------------------------------------------------------

ErrorParts split_error(std::span<const double> estimates, double exact) {
  // 1. The variance of one estimate about its expected value, from n estimates, without bias.
  // 2. The square of (mean - exact) has that of the mean in it as well: how much, on average?
  // 3. Numbers far from 0: subtract before you square.
  carlo::not_implemented("Lab 9.1", "Summary");
}

double fitted_slope(std::span<const double> n, std::span<const double> error) {
  // 1. The straight line through (log n, log error) whose squared distances have the least sum.
  carlo::not_implemented("Lab 9.1", "Summary");
}

double overtakes_after(double a, double b, double bias2) {
  // 1. Where do a/t and bias2 + b/t meet? And who is ahead before and behind that?
  carlo::not_implemented("Lab 9.1", "Summary");
}

}  // namespace lab09
