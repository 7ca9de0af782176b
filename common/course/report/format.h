#pragma once

#include <cstdint>
#include <string>

namespace carlo {

/// Formats a number for people to `digits` significant digits: "0.0123", "1.23e-5", "nan". Fixed
/// between 1e-3 and 1e6, scientific elsewhere; trailing zeros are dropped.
std::string number_text(double value, int digits = 4);

/// Formats a count for people, with a thin space every three digits from five digits on: "4096",
/// "16 384".
std::string count_text(std::int64_t count);

/// Formats a duration for people with its unit: "12.3 ns", "4.56 µs", "7.8 ms", "12 s".
std::string duration_text(double seconds);

/// Formats "-0.501 ± 0.012": the half width to two significant digits, the value to the same place.
std::string interval_text(double value, double half_width);

}  // namespace carlo
