#pragma once

#include "generators.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lab03 {

/// The input of a test: the first numbers of a stream.
struct Sample {
  std::span<const std::uint32_t> words;  ///< numbers at the top of each word (generators.h)
  int bits = 32;
  Lags lags{24, 55};
};

/// A test's result on a sample, or nothing where the distribution of the test is not known: for
/// samples that are too short or too long, or numbers of too few bits.
using Outcome = std::optional<TestResult>;

struct RandomnessTest {
  std::string key;     ///< for tables in JSON
  std::string name;    ///< for display
  std::string about;   ///< one sentence
  int most_log2 = 24;  ///< no sample larger than 2^this is used
  Outcome (*run)(const Sample& sample);
};

/// Equidistribution of the top and of the lowest bits, lag-1 correlation, serial tests in 2D and 3D
/// and on lagged triples, gaps, runs, collisions, birthday spacings, matrix ranks, linear
/// complexity. Tests that count cells use your chi_square (Lab 3.7).
const std::vector<RandomnessTest>& battery();

/// The two-sided p-value: twice the smaller tail, at most 1.
double two_sided(const TestResult& result);

/// Both tails, each including the value itself, of the distributions of the results.
TestResult normal_result(double z);
TestResult poisson_result(std::int64_t count, double mean);
TestResult binomial_result(std::int64_t count, std::int64_t n, double p);

// The tests, one function each.
Outcome top_bits_test(const Sample& sample);
Outcome low_bits_test(const Sample& sample);
Outcome correlation_test(const Sample& sample);
Outcome serial_2d_test(const Sample& sample);
Outcome serial_3d_test(const Sample& sample);
Outcome lagged_triples_test(const Sample& sample);
Outcome gap_test(const Sample& sample);
Outcome runs_test(const Sample& sample);
Outcome collision_test(const Sample& sample);
Outcome birthday_2d_test(const Sample& sample);
Outcome birthday_1d_test(const Sample& sample);
Outcome rank_low_bit_test(const Sample& sample);
Outcome rank_words_test(const Sample& sample);
Outcome linear_complexity_test(const Sample& sample);

}  // namespace lab03
