#pragma once

#include "random/rng.h"
#include "support/error.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

// What the site's pages compute. Pages call functions by name, on numbers: in a browser through
// WebAssembly (module.cpp), and in the native program (native.cpp) with which the test of the site
// compares them. A file of this folder holds the functions of one lab.

namespace site {

using Numbers = std::vector<double>;

/// The arguments of a call. Indices into the results of earlier calls and ranges are the page's
/// responsibility; an argument that is missing throws carlo::Error.
class Arguments {
 public:
  explicit Arguments(std::span<const double> numbers) : numbers_(numbers) {}
  double operator[](std::size_t i) const {
    if (i >= numbers_.size()) throw carlo::Error("a call lacks its argument {}", i);
    return numbers_[i];
  }
  std::int64_t whole(std::size_t i) const { return static_cast<std::int64_t>((*this)[i]); }
  std::size_t index(std::size_t i) const { return static_cast<std::size_t>((*this)[i]); }
  /// A generator from a seed, a whole number in [0, 2^53], and another argument: runs of different
  /// sizes share no numbers.
  carlo::Rng rng(std::size_t seed, std::size_t stream) const {
    return carlo::Rng(static_cast<std::uint64_t>((*this)[seed]),
                      static_cast<std::uint64_t>((*this)[stream]));
  }
  std::span<const double> from(std::size_t i) const { return numbers_.subspan(i); }

 private:
  std::span<const double> numbers_;
};

/// A function that pages can call; defined at namespace scope, it registers itself.
class Function {
 public:
  using Call = Numbers (*)(const Arguments&);
  Function(const char* name, Call call);
  /// Throws carlo::Error if there is no function of that name.
  static Numbers call(const std::string& name, std::span<const double> arguments);

 private:
  const char* name_;
  Call call_;
  const Function* before_;
};

/// The root mean square of trial() - exact over `runs` calls; one call each.
template <class Trial>
double rms_error(std::int64_t runs, double exact, const Trial& trial) {
  double sum = 0;
  for (std::int64_t i = 0; i < runs; ++i) {
    const double error = trial() - exact;
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(runs));
}

}  // namespace site
