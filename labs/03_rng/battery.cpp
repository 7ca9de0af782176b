#include "battery.h"

#include "stats/distributions.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/poisson.hpp>

#include <algorithm>

namespace lab03 {

double two_sided(const TestResult& result) {
  return std::min(1.0, 2 * std::min(result.p_lower, result.p_upper));
}

TestResult normal_result(double z) {
  const double outer = carlo::normal_two_sided(z) / 2;
  return z < 0 ? TestResult{z, outer, 1 - outer} : TestResult{z, 1 - outer, outer};
}

TestResult poisson_result(std::int64_t count, double mean) {
  const boost::math::poisson_distribution<double> poisson(mean);
  const auto x = static_cast<double>(count);
  return {x, boost::math::cdf(poisson, x),
          count == 0 ? 1 : boost::math::cdf(boost::math::complement(poisson, x - 1))};
}

TestResult binomial_result(std::int64_t count, std::int64_t n, double p) {
  const boost::math::binomial_distribution<double> binomial(static_cast<double>(n), p);
  const auto x = static_cast<double>(count);
  return {x, boost::math::cdf(binomial, x),
          count == 0 ? 1 : boost::math::cdf(boost::math::complement(binomial, x - 1))};
}

const std::vector<RandomnessTest>& battery() {
  static const std::vector<RandomnessTest> all = {
      {"top_bits", "χ², top 10 bits", "Are all 1024 values of the top bits equally frequent?", 24,
       top_bits_test},
      {"low_bits", "χ², low 8 bits", "The same for the lowest bits.", 24, low_bits_test},
      {"correlation", "lag-1 correlation", "Does a number tell the next one's size?", 24,
       correlation_test},
      {"serial_2d", "serial 2D, 256²", "Pairs as points of a square: equally many in each cell?",
       24, serial_2d_test},
      {"serial_3d", "serial 3D, 64³", "Triples as points of a cube: equally many in each cell?", 24,
       serial_3d_test},
      {"lagged", "lagged 3D, 16³", "The numbers k and j before and the number itself as a triple.",
       24, lagged_triples_test},
      {"gaps", "gaps, p = 1/16", "How long is the wait between numbers below 1/16?", 24, gap_test},
      {"runs", "runs up", "How long do the numbers keep rising?", 24, runs_test},
      {"collisions", "collisions, 2 × 15 bits",
       "Pairs thrown into 2^30 urns: how many hit a full one?", 22, collision_test},
      {"birthdays_2d", "birthday spacings, 2 × 20 bits",
       "Pairs as days of a long year: how many distances between birthdays repeat?", 18,
       birthday_2d_test},
      {"birthdays_1d", "birthday spacings, 32 bits",
       "The same with single numbers, 2048 at a time.", 17, birthday_1d_test},
      {"rank_low_bit", "matrix rank, lowest bit",
       "64 × 64 matrices of lowest bits: are they regular?", 20, rank_low_bit_test},
      {"rank_words", "matrix rank, 32 bits", "64 × 64 matrices of whole words: are they regular?",
       20, rank_words_test},
      {"complexity", "linear complexity", "How long a shift register makes the lowest bits?", 16,
       linear_complexity_test},
  };
  return all;
}

}  // namespace lab03
