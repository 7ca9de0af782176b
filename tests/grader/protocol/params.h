#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

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

/// As they go over the worker's command line: "seed=7 n=100 k=2.5", numbers in the order of their
/// names; every double survives unchanged. Throws Error where a name holds a blank or '='.
std::string to_text(const Params& params);
/// Throws Error when the text is not what to_text() writes.
Params params_from_text(std::string_view text);

}  // namespace carlo::grader
