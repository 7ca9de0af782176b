#pragma once

#include "grader/judge/judge.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lab03_tests {

/// The sequence of a typical mistake.
struct Alternative {
  std::vector<double> sequence;
  carlo::grader::Diagnosis diagnosis;
};

/// How numbers are displayed to the student.
enum class Digits { decimal, hexadecimal };

/// Checks that every number equals the expected one; otherwise names the mistakes that give exactly
/// these numbers.
inline carlo::grader::Verdict sequence_is(const std::string& what,
                                          const std::vector<double>& measured,
                                          const std::vector<double>& expected,
                                          const std::vector<Alternative>& alternatives = {},
                                          Digits digits = Digits::decimal) {
  carlo::grader::Verdict verdict = carlo::grader::all_equal(what, measured, expected, 0);
  if (verdict.passed) return verdict;
  const auto [x, y] =
      std::mismatch(measured.begin(), measured.end(), expected.begin(), expected.end());
  if (digits == Digits::hexadecimal && x != measured.end() && y != expected.end()) {
    verdict.measured = fmt::format("0x{:08x}", static_cast<std::uint64_t>(*x));
    verdict.expected = fmt::format("0x{:08x}", static_cast<std::uint64_t>(*y));
  }
  for (const Alternative& other : alternatives) {
    if (measured == other.sequence) verdict.diagnoses.push_back(other.diagnosis);
  }
  return verdict;
}

/// n values of a function of no arguments.
inline std::vector<double> generate(std::int64_t n, const std::function<double()>& next) {
  std::vector<double> values;
  for (std::int64_t i = 0; i < n; ++i)
    values.push_back(next());
  return values;
}

}  // namespace lab03_tests
