#include "grader/judge/effect.h"

#include "grader/judge/compare.h"
#include "stats/distributions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carlo::grader {
namespace {

/// No effect can be detected: the comparison has no values, or its theory is not a number.
constexpr double blind = std::numeric_limits<double>::infinity();

/// Return the distances of the level and of the power from the middle of a normal statistic, in
/// standard errors.
double level_z() {
  return normal_two_sided_quantile(comparison_alpha());
}
double power_z() {
  return normal_two_sided_quantile(2 * (1 - claimed_power));
}

}  // namespace

Effect effect_on_mean(double off, double sd, double count, double variance) {
  if (!(count > 0)) return {off, blind, ""};
  Effect effect{off, (level_z() + power_z()) * sd / std::sqrt(count), ""};
  if (count > 1) effect.spread = variance / (sd * sd);
  return effect;
}

Effect effect_on_variance(double ratio, double freedom) {
  const std::string unit = "of the variance";
  if (!(freedom > 0) || std::isinf(freedom)) return {ratio - 1, blind, unit};
  const double critical = chi_square_upper_quantile(comparison_alpha() / 2, freedom);
  // Too large a variance is harder to detect than too small a one.
  return {ratio - 1, critical / chi_square_lower_quantile(1 - claimed_power, freedom) - 1, unit};
}

Effect effect_on_distribution(double distance, double count) {
  const std::string unit = "of probability";
  if (!(count > 0)) return {distance, blind, unit};
  // The level's critical distance from the tail's first term, 2 exp(-2 n d^2); and a share of
  // values has a standard deviation of at most 1 / (2 sqrt(n)).
  const double critical = std::sqrt(std::log(2 / comparison_alpha()) / 2);
  return {distance, (critical + power_z() / 2) / std::sqrt(count), unit};
}

Effect effect_on_cells(double statistic, double freedom, double count) {
  const std::string unit = "rms of the cells' relative errors";
  const double seen = std::sqrt(std::max(0.0, statistic - freedom) / count);
  if (!(freedom > 0 && count > 0)) return {seen, blind, unit};
  const double critical = chi_square_upper_quantile(comparison_alpha() / 2, freedom);
  const double noncentrality = chi_square_noncentrality(critical, freedom, 1 - claimed_power);
  return {seen, std::sqrt(noncentrality / count), unit};
}

}  // namespace carlo::grader
