#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace carlo::grader {

/// What a check asks of a probe: a seed, a count, and further numbers by name.
struct Params {
  std::uint64_t seed = 0;
  std::int64_t n = 0;
  std::map<std::string, double> numbers = {};

  /// A named number; throws Error when the check did not send it.
  double operator[](const std::string& name) const;
  /// A named whole number; throws Error when it is missing or not whole.
  std::int64_t whole(const std::string& name) const;
};

/// JSON, as it goes over the worker's command line; every double survives unchanged.
std::string to_json(const Params& params);
/// Throws Error when the text is not what to_json() writes.
Params params_from_json(const std::string& text);

}  // namespace carlo::grader
