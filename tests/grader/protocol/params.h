#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace carlo::grader {

/// A check's input for a probe: a seed, a count, and further numbers by name.
struct Params {
  std::uint64_t seed = 0;
  std::int64_t n = 0;
  std::map<std::string, double> numbers = {};

  /// Returns a named number; throws Error if the check did not send it.
  double operator[](const std::string& name) const;
  /// Returns a named integer; throws Error if it is missing or not whole.
  std::int64_t whole(const std::string& name) const;
};

/// Formats the parameters for the worker's command line: "seed=7 n=100 k=2.5", numbers in the order
/// of their names; every double survives unchanged. Throws Error if a name contains a blank or '='.
std::string to_text(const Params& params);
/// Throws Error unless the text was written by to_text().
Params params_from_text(std::string_view text);

}  // namespace carlo::grader
