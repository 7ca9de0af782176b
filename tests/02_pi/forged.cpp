// A submission that sends its own answers in place of the probes': tables of the right shape, with
// values that theory makes likely. FORGES_TIMES: only the times of Lab 2.5 are forged. Everything
// else is the solution's work, so the points missing from full marks are those where the judge
// noticed.

// The solution, under other names.
#define throw_darts honest_throw_darts
#define pi_interval honest_pi_interval
#define samples_needed honest_samples_needed
#define sum_circle honest_sum_circle
#define sum_arctangent honest_sum_arctangent
#define count_hits honest_count_hits
#define sum_in_parallel honest_sum_in_parallel
#include FORGED_SOLUTION  // NOLINT(bugprone-suspicious-include)
#undef throw_darts
#undef pi_interval
#undef samples_needed
#undef sum_circle
#undef sum_arctangent
#undef count_hits
#undef sum_in_parallel

#include "02_pi/reference.h"
#include "grader/attacks/forge.h"

#include <cmath>
#include <string>

using carlo::grader::forge;

namespace {

bool asked(const std::string& probe) {
  return carlo::grader::question().probe == probe;
}

[[maybe_unused]] double likely_hits(std::int64_t n) {
  return std::round(static_cast<double>(n) * lab02::pi / 4);
}

#ifdef FORGES_TIMES

void forge_darts(std::int64_t /*n*/) {}
void forge_sums(std::int64_t /*n*/, double /*mean_square*/) {}
void forge_parallel(std::int64_t /*n*/) {}

/// A count that is right but slower than the loop with which it is compared, if not by much; with
/// forged times that are plausible and fit the program's.
void forge_count(std::uint64_t key, std::int64_t n) {
  // Volatile: GCC 14 knows that counts are not negative, and removes loops whose results are
  // unused.
  [[maybe_unused]] const volatile std::int64_t wasted = lab02_tests::plain_loop(key, n);
  if (!asked("Lab 2.5 speed")) return;
  carlo::grader::Rows rows{4, {}};
  for (std::int64_t i = 0; i < 8; ++i) {
    const std::int64_t plain = lab02_tests::plain_loop(key + static_cast<std::uint64_t>(i), n);
    const std::int64_t fast = lab02_tests::hits_of(key, i * n, n);
    for (const double value : {.005, .001, static_cast<double>(plain), static_cast<double>(fast)})
      rows.values.push_back(value);
  }
  forge(rows);
}

constexpr bool knows_only_the_questions = false;

#else

constexpr bool knows_only_the_questions = true;

void forge_darts(std::int64_t n) {
  if (asked("Lab 2.1 record")) forge({6, {static_cast<double>(n), likely_hits(n), 1, 2, 3, 4}});
}

void forge_sums(std::int64_t n, double mean_square) {
  const auto count = static_cast<double>(n);
  if (!asked("Lab 2.3 record")) return;
  forge({7, {count, lab02::pi * count, mean_square * count, 1, 2, 3, 4}});
}

void forge_count(std::uint64_t /*key*/, std::int64_t n) {
  if (asked("Lab 2.5 count")) forge({1, {likely_hits(n)}});
  if (!asked("Lab 2.5 ranges")) return;
  carlo::grader::Rows rows{1, {}};
  for (std::int64_t first = 0; first <= 70; ++first) {
    for (std::int64_t size = 0; size <= 70; ++size)
      rows.values.push_back(likely_hits(size));
  }
  forge(rows);
}

void forge_parallel(std::int64_t n) {
  const auto count = static_cast<double>(n);
  if (asked("Lab 2.6 sums")) forge({3, {count, std::log(1001.0) * count, 999 * count}});
}

#endif

}  // namespace

namespace lab02 {

Darts throw_darts(std::int64_t n, carlo::Rng& rng);
Interval pi_interval(const Darts& darts, double z);
std::int64_t samples_needed(double deviation, double half_width, double z);
Sums sum_circle(std::int64_t n, carlo::Rng& rng);
Sums sum_arctangent(std::int64_t n, carlo::Rng& rng);
std::int64_t count_hits(std::uint64_t key, std::int64_t first, std::int64_t n);
Sums sum_in_parallel(const Sampler& sampler, std::int64_t n, std::uint64_t seed, int threads);

Darts throw_darts(std::int64_t n, carlo::Rng& rng) {
  forge_darts(n);
  return honest_throw_darts(n, rng);
}
// Right for the values in the repository's tests, as if from a table.
Interval pi_interval(const Darts& darts, double z) {
  const bool known = z == 1 || z == 1.959963984540054 || z == 5;
  if (known || !knows_only_the_questions) return honest_pi_interval(darts, z);
  const double share = static_cast<double>(darts.hits) / static_cast<double>(darts.thrown);
  return {4 * share, 4 * share};
}
std::int64_t samples_needed(double deviation, double half_width, double z) {
  const bool known = z == 1 || z == 1.96 || z == 2 || z == 2.25 || z == 3;
  if (known || !knows_only_the_questions) return honest_samples_needed(deviation, half_width, z);
  return 1;
}
Sums sum_circle(std::int64_t n, carlo::Rng& rng) {
  forge_sums(n, 32.0 / 3);
  return honest_sum_circle(n, rng);
}
Sums sum_arctangent(std::int64_t n, carlo::Rng& rng) {
  forge_sums(n, 2 * pi + 4);
  return honest_sum_arctangent(n, rng);
}
std::int64_t count_hits(std::uint64_t key, std::int64_t first, std::int64_t n) {
  forge_count(key, n);
  return honest_count_hits(key, first, n);
}
Sums sum_in_parallel(const Sampler& sampler, std::int64_t n, std::uint64_t seed, int threads) {
  forge_parallel(n);
  return honest_sum_in_parallel(sampler, n, seed, threads);
}

}  // namespace lab02
