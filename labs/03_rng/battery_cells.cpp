#include "battery.h"

#include <algorithm>
#include <cmath>

// Tests that count cells: equidistribution, serial tests, gaps, runs; and the correlation.
// Source: Knuth, "The Art of Computer Programming" 2, section 3.3.2.

namespace lab03 {
namespace {

/// Chi-square of `counts` against n shares of equal probability.
TestResult equal_cells(std::span<const std::int64_t> counts, std::int64_t n) {
  const double each = static_cast<double>(n) / static_cast<double>(counts.size());
  return chi_square(counts, std::vector<double>(counts.size(), each));
}

/// Tests n points in cells. With less than one point per cell, the distribution of chi-square is
/// not known well; the number of pairs in one cell, which is the same statistic, is then nearly
/// Poisson. Returns nothing below 16 expected pairs, nor where the Poisson approximation fails (its
/// next term is of that size).
Outcome points_in_cells(std::span<const std::int64_t> counts, std::int64_t n) {
  const auto cells = static_cast<double>(counts.size());
  const auto points = static_cast<double>(n);
  if (points >= cells) return equal_cells(counts, n);
  const double expected_pairs = points * (points - 1) / (2 * cells);
  if (points > cells / 8 || expected_pairs < 16) return std::nullopt;
  std::int64_t pairs = 0;
  for (const std::int64_t count : counts)
    pairs += count * (count - 1) / 2;
  return poisson_result(pairs, expected_pairs);
}

/// Points of `dimensions` consecutive words, by their top `bits` bits.
Outcome serial(const Sample& sample, std::size_t dimensions, int bits) {
  std::vector<std::int64_t> counts(std::size_t{1} << (static_cast<int>(dimensions) * bits));
  std::int64_t points = 0;
  for (std::size_t i = 0; i + dimensions <= sample.words.size(); i += dimensions, ++points) {
    std::size_t cell = 0;
    for (std::size_t d = 0; d < dimensions; ++d)
      cell = cell << bits | sample.words[i + d] >> (32 - bits);
    ++counts[cell];
  }
  return points_in_cells(counts, points);
}

/// Counts against cell probabilities; the cells of the tail are pooled until at least 16 are
/// expected in the last one.
TestResult with_pooled_tail(std::vector<std::int64_t> counts, std::vector<double> probabilities,
                            std::int64_t n) {
  const double least = 16 / static_cast<double>(n);
  while (counts.size() > 2 && probabilities.back() < least) {
    counts[counts.size() - 2] += counts.back();
    probabilities[probabilities.size() - 2] += probabilities.back();
    counts.pop_back();
    probabilities.pop_back();
  }
  for (double& p : probabilities)
    p *= static_cast<double>(n);
  return chi_square(counts, probabilities);
}

}  // namespace

Outcome top_bits_test(const Sample& sample) {
  if (sample.words.size() < 4096) return std::nullopt;
  return equidistribution(sample.words, 22, 10);
}

Outcome low_bits_test(const Sample& sample) {
  if (sample.words.size() < 4096) return std::nullopt;
  return equidistribution(sample.words, 32 - sample.bits, 8);
}

Outcome correlation_test(const Sample& sample) {
  const std::size_t n = sample.words.size();
  if (n < 1024) return std::nullopt;
  const auto centred = [&](std::size_t i) { return sample.words[i] * 0x1p-32 - 0.5; };
  // slide: correlation
  double sum = 0, before = centred(0);
  for (std::size_t i = 1; i < n; ++i) {
    const double now = centred(i);
    sum += before * now;
    before = now;
  }
  return normal_result(12 * sum / std::sqrt(static_cast<double>(n - 1)));
  // end slide
}

Outcome serial_2d_test(const Sample& sample) {
  return serial(sample, 2, 8);
}

Outcome serial_3d_test(const Sample& sample) {
  return serial(sample, 3, 6);
}

Outcome lagged_triples_test(const Sample& sample) {
  const auto j = static_cast<std::size_t>(sample.lags.j);
  const auto k = static_cast<std::size_t>(sample.lags.k);
  std::vector<std::int64_t> counts(4096);
  std::int64_t triples = 0;
  // Starts n, n + 1, ... of one block use the numbers n - k, n - j and n; no number is used twice
  // if the block is no longer than j and k - j.
  const std::size_t block = std::min(j, k - j);
  for (std::size_t first = k; first + block <= sample.words.size(); first += k + block) {
    for (std::size_t i = first; i < first + block; ++i, ++triples)
      ++counts[(sample.words[i - k] >> 28) << 8 | (sample.words[i - j] >> 28) << 4 |
               sample.words[i] >> 28];
  }
  return points_in_cells(counts, triples);
}

Outcome gap_test(const Sample& sample) {
  // Enough gaps that a good generator fits into the sample in all but one of 10^9 cases.
  const auto n = static_cast<double>(sample.words.size());
  const double hits = n / 16;
  const auto wanted = static_cast<std::int64_t>(hits - 6 * std::sqrt(hits * 15 / 16));
  if (wanted < 128) return std::nullopt;
  constexpr std::size_t longest = 160;
  std::vector<std::int64_t> counts(longest + 1);
  std::int64_t gaps = 0;
  std::size_t gap = 0;
  for (std::size_t i = 0; i < sample.words.size() && gaps < wanted; ++i) {
    if (sample.words[i] >> 28 != 0) {
      ++gap;
      continue;
    }
    ++counts[std::min(gap, longest)];
    ++gaps;
    gap = 0;
  }
  if (gaps < wanted) {
    return binomial_result(gaps, static_cast<std::int64_t>(sample.words.size()), 1.0 / 16);
  }
  std::vector<double> probabilities(longest + 1);
  double waiting = 1;
  for (std::size_t length = 0; length < longest; ++length) {
    probabilities[length] = waiting / 16;
    waiting *= 15.0 / 16;
  }
  probabilities[longest] = waiting;
  return with_pooled_tail(std::move(counts), std::move(probabilities), gaps);
}

// The number that ends a run is left out, which makes the runs independent: a run of length r or
// more has probability 1 / r! (Knuth, exercise 3.3.2-14).
Outcome runs_test(const Sample& sample) {
  if (sample.words.size() < 2048) return std::nullopt;
  constexpr std::size_t longest = 7;
  std::vector<std::int64_t> counts(longest);
  std::int64_t runs = 0;
  std::size_t length = 1;
  // A run cut off by the end of the sample is left out; 16 numbers hold any run.
  for (std::size_t i = 1; i < sample.words.size(); ++i) {
    if (sample.words[i] > sample.words[i - 1]) {
      ++length;
      continue;
    }
    ++counts[std::min(length, longest) - 1];
    ++runs;
    length = 1;
    ++i;
    if (i + 16 >= sample.words.size()) break;
  }
  // A good generator has n / e of them. For far fewer, a binomial with 0.3 < 1 / e bounds the
  // probability.
  if (runs < 256) return binomial_result(runs, static_cast<std::int64_t>(sample.words.size()), 0.3);
  std::vector<double> probabilities;
  double factorial = 1;
  for (std::size_t r = 1; r < longest; ++r) {
    const double at_least = 1 / factorial;
    factorial *= static_cast<double>(r + 1);
    probabilities.push_back(at_least - 1 / factorial);
  }
  probabilities.push_back(1 / factorial);
  return with_pooled_tail(std::move(counts), std::move(probabilities), runs);
}

}  // namespace lab03
