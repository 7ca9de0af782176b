// The battery: right p-values on good streams, and the known weaknesses of bad ones.

#include "battery.h"

#include "random/rng.h"
#include "stats/distributions.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <cmath>

using namespace lab03;

namespace {

const RandomnessTest& test(const std::string& key) {
  const auto found = std::find_if(battery().begin(), battery().end(),
                                  [&](const RandomnessTest& t) { return t.key == key; });
  REQUIRE(found != battery().end());
  return *found;
}

std::vector<std::uint32_t> stream(const std::string& key, int log2_n, std::uint64_t seed = 1) {
  std::vector<std::uint32_t> words(std::size_t{1} << log2_n);
  find_generator(key).make(seed)(words);
  return words;
}

Outcome outcome(const std::string& generator, const std::string& test_key, int log2_n) {
  const Generator& g = find_generator(generator);
  const auto words = stream(generator, log2_n);
  return test(test_key).run({words, g.bits, g.lags});
}

bool rejects(const std::string& generator, const std::string& test_key, int log2_n) {
  const Outcome result = outcome(generator, test_key, log2_n);
  return result && two_sided(*result) < 1e-10;
}

/// A p-value for the distance between the distribution of `replicates` p-values of Philox streams
/// and the uniform one. For discrete statistics, p is spread over the probability of the value
/// itself by a separate random number.
double calibration(const RandomnessTest& t, std::size_t n, std::size_t replicates) {
  std::vector<double> p;
  std::vector<std::uint32_t> words(n);
  for (std::size_t i = 0; i < replicates; ++i) {
    carlo::Rng rng(20'000 + i, n), spread(i, 77);
    for (std::uint32_t& word : words)
      word = rng.next_u32();
    const Outcome result = t.run({words});
    if (!result) return -1;
    const double own = result->p_lower + result->p_upper - 1;
    p.push_back(result->p_upper - spread.uniform() * std::max(0.0, own));
  }
  std::sort(p.begin(), p.end());
  double distance = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto count = static_cast<double>(p.size());
    distance = std::max({distance, p[i] - static_cast<double>(i) / count,
                         static_cast<double>(i + 1) / count - p[i]});
  }
  return carlo::kolmogorov_smirnov(distance, p.size());
}

}  // namespace

// 1000 streams per size: a distribution that is off by .08 anywhere is detected with power .999.
// About 28 tests at alpha 1e-5 each; the seeds are fixed.
TEST_CASE("each test's p-values are uniform on 1000 good streams", "[calibration]") {
  for (const RandomnessTest& t : battery()) {
    int sizes = 0;
    for (int log2_n = 10; log2_n <= std::min(t.most_log2, 18) && sizes < 2; ++log2_n) {
      const std::size_t n = std::size_t{1} << log2_n;
      if (!t.run({std::vector<std::uint32_t>(n)})) continue;
      // The smallest sample that the guard admits, and one four times as large.
      if (sizes == 1) log2_n = std::min({log2_n + 1, t.most_log2, 18});
      const double p = calibration(t, std::size_t{1} << log2_n, 1000);
      INFO(t.name << ", 2^" << log2_n << " numbers: KS p = " << p);
      if (p < 0) continue;
      CHECK(p >= 1e-5);
      ++sizes;
    }
    INFO(t.name);
    CHECK(sizes >= 1);
  }
}

TEST_CASE("each generator is caught by the tests that are known to catch it") {
  CHECK(rejects("lcg", "low_bits", 12));
  CHECK(rejects("randu", "low_bits", 12));
  CHECK(rejects("randu", "serial_3d", 14));
  CHECK(rejects("lcg", "collisions", 20));
  CHECK(rejects("lcg", "birthdays_2d", 15));
  CHECK(rejects("randu", "birthdays_2d", 15));
  CHECK(rejects("minstd", "birthdays_2d", 15));
  CHECK(rejects("lcg", "rank_words", 14));
  CHECK(rejects("mt19937", "complexity", 16));
  for (const char* lags : {"7-10", "5-17", "6-31", "24-55", "31-63"}) {
    for (const char* combine : {"add", "sub", "xor"}) {
      const std::string key = std::string("lfg-").append(lags).append("-").append(combine);
      INFO(key);
      CHECK(rejects(key, "rank_low_bit", 20));
      CHECK(rejects(key, "lagged", 16));
      // With xor (24, 55) the p-value stays near 1e-8.
      if (std::string(combine) != "xor") CHECK(rejects(key, "birthdays_1d", 17));
      CHECK(rejects(key, "complexity", 12));
    }
    CHECK(rejects(std::string("lfg-").append(lags).append("-xor"), "rank_words", 14));
  }
}

TEST_CASE("both tails reject: bits that are too even as well as bits that are too uneven") {
  const Outcome even = outcome("lcg", "low_bits", 16);
  REQUIRE(even.has_value());
  CHECK(even->statistic == 0);
  CHECK(even->p_lower <= 1e-10);
  CHECK(even->p_upper >= 0.999);
  const Outcome uneven = outcome("randu", "low_bits", 16);
  REQUIRE(uneven.has_value());
  CHECK(uneven->p_upper <= 1e-10);
}

// Both pass although their triples lie on planes: the correlation only sees the sizes of
// neighbours.
TEST_CASE("the correlation of neighbours catches neither the LCG nor RANDU") {
  CHECK_FALSE(rejects("lcg", "correlation", 22));
  CHECK_FALSE(rejects("randu", "correlation", 22));
}

TEST_CASE("samples outside a test's range are not judged") {
  const std::vector<std::uint32_t> few(512);
  for (const RandomnessTest& t : battery()) {
    INFO(t.name);
    CHECK_FALSE(t.run({few}).has_value());
  }
  CHECK_FALSE(outcome("randu", "birthdays_1d", 14).has_value());
  CHECK_FALSE(outcome("minstd", "rank_words", 14).has_value());
  // With this many rounds, good generators would fail.
  const auto words = stream("philox", 19);
  CHECK_FALSE(birthday_1d_test({words}).has_value());
}

TEST_CASE("good generators pass all tests") {
  for (const char* key : {"pcg32", "xoshiro128", "philox", "splitmix64"}) {
    for (const RandomnessTest& t : battery()) {
      INFO(key << ", " << t.name);
      CHECK_FALSE(rejects(key, t.key, std::min(t.most_log2, 20)));
    }
  }
}
