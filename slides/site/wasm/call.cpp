#include "call.h"

#include "stats/fit.h"
#include "stats/running_mean.h"
#include "support/error.h"

namespace site {

static const Function* last_function = nullptr;

Function::Function(const char* name, Call call) : name_(name), call_(call), before_(last_function) {
  last_function = this;
}

Numbers Function::call(const std::string& name, std::span<const double> arguments) {
  for (const Function* one = last_function; one != nullptr; one = one->before_)
    if (name == one->name_) return one->call_(Arguments(arguments));
  throw carlo::Error("the site has no function '{}'", name);
}

/// slope x... y...: the slope of log y against log x, and the half width of its 95 % interval.
static const Function slope("slope", [](const Arguments& given) -> Numbers {
  const auto all = given.from(0);
  const std::size_t n = all.size() / 2;
  const carlo::PowerFit fit = carlo::fit_power_law(all.first(n), all.last(n));
  return {fit.slope, fit.slope_half_width};
});

/// group_slope n x... y...: as slope, for independent groups of n points at the same x. The points
/// of a group need not be independent, as errors of one growing sample are not: the interval is
/// Student's t of the groups' slopes.
static const Function group_slope("group_slope", [](const Arguments& given) -> Numbers {
  const std::size_t n = given.index(0);
  const auto x = given.from(1).first(n), ys = given.from(1 + n);
  carlo::RunningMean slopes;
  for (std::size_t at = 0; at + n <= ys.size(); at += n)
    slopes.add(carlo::fit_power_law(x, ys.subspan(at, n)).slope);
  const auto groups = static_cast<std::size_t>(slopes.count());
  return {slopes.mean(), carlo::student_half_width(0.95, groups - 1) * slopes.error()};
});

}  // namespace site
