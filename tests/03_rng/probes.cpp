// Probes of lab 3's generators: 3.1 to 3.4. They call the student's functions and return raw
// values; checks_*.cpp says what the values should be.

#include "03_rng/words.h"
#include "grader/worker/probe.h"
#include "rng.h"

#include <ctime>
#include <limits>

using namespace lab03_tests;
using carlo::grader::Rows;
using carlo::grader::RowWriter;

namespace {

/// n numbers of a generator, one by one.
template <class Generator>
Rows numbers(Generator& generator, std::int64_t n) {
  RowWriter rows;
  for (std::int64_t i = 0; i < n; ++i)
    rows.add({static_cast<double>(generator.next())});
  return rows.take();
}

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// The time of jumps of 2^28 steps in all, 2^24 at a time.
double jump_seconds() {
  lab03::Lcg generator(1);
  const double start = processor_seconds();
  for (int i = 0; i < 16; ++i)
    generator.discard(std::uint64_t{1} << 24);
  // The final state is used, so the steps cannot be optimised away.
  volatile std::uint32_t last = generator.next();
  (void)last;
  return processor_seconds() - start;
}

}  // namespace

PROBE("Lab 3.1 numbers", "number") {
  lab03::Lcg generator(static_cast<std::uint32_t>(params.whole("x0")));
  return numbers(generator, params.n);
}

PROBE("Lab 3.2 jump", "number after the jump") {
  lab03::Lcg generator(static_cast<std::uint32_t>(params.whole("x0")));
  generator.discard(wide_word(params, "steps"));
  return numbers(generator, params.n);
}

PROBE("Lab 3.2 cost", "seconds") {
  return {1, {jump_seconds()}};
}

// Jumps too long for single steps: NaN for a generator that would try.
PROBE("Lab 3.2 long jump", "number after the jump",
      "(nan: jumps take too long for this one to be tried)") {
  if (jump_seconds() > 0.05) return {1, {std::numeric_limits<double>::quiet_NaN()}};
  lab03::Lcg generator(static_cast<std::uint32_t>(params.whole("x0")));
  generator.discard(wide_word(params, "steps"));
  return numbers(generator, 1);
}

// One row for each of n consecutive seeds: its first k words, twice.
PROBE("Lab 3.3 first words", "word ...", "again, word ...",
      "(a row a seed: its words, and those that the same call gives again)") {
  const auto k = static_cast<std::size_t>(params.whole("k"));
  const std::uint64_t seed = wide_word(params, "first");
  Rows rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    for (int again = 0; again < 2; ++again) {
      const auto words =
          lab03::first_words(seed + static_cast<std::uint64_t>(i), static_cast<int>(k));
      if (words.size() != k) return {1, {static_cast<double>(words.size())}};
      rows.values.insert(rows.values.end(), words.begin(), words.end());
    }
  }
  rows.columns = 2 * k;
  return rows;
}

// The n numbers after k words that follow from the seed.
PROBE("Lab 3.3 recurrence", "number") {
  const lab03::Lags lags{static_cast<int>(params.whole("j")), static_cast<int>(params.whole("k"))};
  lab03::LaggedFibonacci generator(lags, static_cast<lab03::Combine>(params.whole("combine")),
                                   random_words(params.seed, lags.k));
  return numbers(generator, params.n);
}

// Started with 31 given words ("word0" ...); skips the first `skip` numbers.
PROBE("Lab 3.3 known answer", "number") {
  std::vector<std::uint32_t> first;
  for (int i = 0; i < 31; ++i)
    first.push_back(static_cast<std::uint32_t>(params.whole("word" + std::to_string(i))));
  lab03::LaggedFibonacci generator({3, 31}, lab03::Combine::add, first);
  for (std::int64_t i = 0; i < params.whole("skip"); ++i)
    generator.next();
  return numbers(generator, params.n);
}

// The time for n numbers, with k words.
PROBE("Lab 3.3 cost", "seconds") {
  const auto k = static_cast<int>(params.whole("k"));
  lab03::LaggedFibonacci generator({k / 3, k}, lab03::Combine::subtract,
                                   std::vector<std::uint32_t>(static_cast<std::size_t>(k), 1));
  const double start = processor_seconds();
  volatile std::uint32_t last = 0;
  for (std::int64_t i = 0; i < params.n; ++i)
    last = generator.next();
  (void)last;
  return {1, {processor_seconds() - start}};
}

PROBE("Lab 3.4 numbers", "number") {
  lab03::Pcg32 generator(wide_word(params, "seed"), wide_word(params, "stream"));
  return numbers(generator, params.n);
}
