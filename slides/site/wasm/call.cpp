#include "call.h"

#include "stats/fit.h"
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

}  // namespace site
