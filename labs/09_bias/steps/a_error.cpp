#include "bias.h"
#include "course/not_implemented.h"

#include <cmath>
#include <limits>

// Lab 09, step a: separates bias and noise. bias.h says what each function takes and returns.

namespace lab09 {

// Lab 9.1 -----------------------------------------------------------------------------------------

ErrorParts split_error(std::span<const double> estimates, double exact) {
  // 1. How far are the estimates off on average? Subtract before you add up, while all digits are
  //    there.
  // 2. The variance about their own mean, in a second pass, as in Lab 1.3.
  // 3. The mean is itself an estimate, and its square is too large on average. By how much?
  carlo::not_implemented("Lab 9.1", "Summary");
}

double fitted_slope(std::span<const double> n, std::span<const double> error) {
  // 1. A power of n is a straight line on logarithmic axes.
  // 2. Sums over the distances from the mean of log n and from that of log error.
  carlo::not_implemented("Lab 9.1", "Summary");
}

double overtakes_after(double a, double b, double bias2) {
  // 1. Who is ahead at the very start? Who is in the end? Two cases are settled by that.
  // 2. Else: where do a/t and bias2 + b/t meet?
  carlo::not_implemented("Lab 9.1", "Summary");
}

}  // namespace lab09
