#include "grader/judge/numbers.h"

#include "course/report/format.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdint>

namespace carlo::grader {

std::string number_in_report(double x, int digits) {
  constexpr double exact_below = 0x1p53;
  if (std::isnan(x)) return "NaN";  // and not "-nan"
  if (std::abs(x) < exact_below && x == std::floor(x)) {
    return count_text(static_cast<std::int64_t>(x));
  }
  return fmt::format("{:.{}g}", x, digits);
}

std::string counted(double count, const std::string& thing) {
  return fmt::format("{} {}{}", number_in_report(count), thing, count == 1 ? "" : "s");
}

}  // namespace carlo::grader
