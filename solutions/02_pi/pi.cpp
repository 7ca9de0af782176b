#include "pi.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <exception>
#include <mutex>
#include <numbers>
#include <thread>
#include <vector>

// Lab 02: π by darts, solved.

namespace lab02 {

using std::numbers::pi;

// Lab 2.1 -----------------------------------------------------------------------------------------

Darts throw_darts(std::int64_t n, carlo::Rng& rng) {
  std::int64_t hits = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    const double x = rng.uniform();
    const double y = rng.uniform();
    if (x * x + y * y < 1) ++hits;
  }
  return {n, hits};
}

Estimate pi_estimate(const Darts& darts) {
  const auto n = static_cast<double>(darts.thrown);
  const double share = static_cast<double>(darts.hits) / n;
  if (darts.thrown < 2) return {4 * share, 0};
  return {4 * share, 4 * std::sqrt(share * (1 - share) / (n - 1))};
}

// Lab 2.2 -----------------------------------------------------------------------------------------

// The roots p of (share - p)^2 = z^2 p (1 - p) / n.
Interval pi_interval(const Darts& darts, double z) {
  const auto n = static_cast<double>(darts.thrown);
  const double share = static_cast<double>(darts.hits) / n;
  const double centre = share + z * z / (2 * n);
  const double half_width = z * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n));
  const double scale = 4 / (1 + z * z / n);
  return {scale * (centre - half_width), scale * (centre + half_width)};
}

// Lab 2.3 -----------------------------------------------------------------------------------------

namespace {

template <class Integrand>
Sums sum_samples(std::int64_t n, carlo::Rng& rng, const Integrand& f) {
  Sums sums{n, 0, 0};
  for (std::int64_t i = 0; i < n; ++i) {
    const double y = f(rng.uniform());
    sums.sum += y;
    sums.squares += y * y;
  }
  return sums;
}

}  // namespace

Sums sum_circle(std::int64_t n, carlo::Rng& rng) {
  return sum_samples(n, rng, [](double x) { return 4 * std::sqrt(1 - x * x); });
}

Sums sum_arctangent(std::int64_t n, carlo::Rng& rng) {
  return sum_samples(n, rng, [](double x) { return 4 / (1 + x * x); });
}

Estimate mean_of(const Sums& sums) {
  const auto n = static_cast<double>(sums.count);
  const double mean = sums.sum / n;
  if (sums.count < 2) return {mean, 0};
  // Equal numbers may round to a spread just below 0.
  const double spread = std::max(sums.squares - n * mean * mean, 0.0);
  return {mean, std::sqrt(spread / (n - 1) / n)};
}

// Lab 2.4 -----------------------------------------------------------------------------------------

// E[Y^2] is 16 π/4, 16 (1 - 1/3) and 16 (π/8 + 1/4); E[Y] is π.
double darts_deviation() {
  return std::sqrt(pi * (4 - pi));
}

double circle_deviation() {
  return std::sqrt(32.0 / 3 - pi * pi);
}

double arctangent_deviation() {
  return std::sqrt(2 * pi + 4 - pi * pi);
}

std::int64_t samples_needed(double deviation, double half_width, double z) {
  const double root = z * deviation / half_width;
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(root * root)));
}

// Lab 2.5 -----------------------------------------------------------------------------------------

namespace {

/// 1 for a miss, 0 for a hit. The centre of a cell lies inside when (x + 1/2)^2 + (y + 1/2)^2 is
/// below 2^32, that is x (x + 1) + y (y + 1) <= 2^32 - 1: when the sum does not overflow 32 bits.
std::uint32_t miss(std::uint32_t dart) {
  const std::uint32_t x = dart & 0xFFFF;
  const std::uint32_t y = dart >> 16;
  const std::uint32_t a = x * (x + 1);
  return a + y * (y + 1) < a ? 1 : 0;
}

std::uint32_t dart_number(std::uint64_t key, std::int64_t i) {
  const std::uint64_t word = dart_word(key, i / 2);
  return static_cast<std::uint32_t>(i % 2 == 0 ? word : word >> 32);
}

/// The misses among the darts of eight words. First the darts, then the tests: loops of one kind
/// of work, which the compiler turns into vector instructions.
std::uint32_t misses_of_block(std::uint64_t key, std::int64_t first_word) {
  std::array<std::uint32_t, 16> darts{};
  for (std::size_t i = 0; i < 8; ++i) {
    const std::uint64_t word = dart_word(key, first_word + static_cast<std::int64_t>(i));
    darts[2 * i] = static_cast<std::uint32_t>(word);
    darts[2 * i + 1] = static_cast<std::uint32_t>(word >> 32);
  }
  std::uint32_t misses = 0;
  for (const std::uint32_t dart : darts)
    misses += miss(dart);
  return misses;
}

}  // namespace

std::int64_t count_hits(std::uint64_t key, std::int64_t first, std::int64_t n) {
  const std::int64_t end = first + n;
  std::int64_t hits = n;
  std::int64_t i = first;
  for (; i < end && i % 2 != 0; ++i)
    hits -= miss(dart_number(key, i));
  for (; end - i >= 16; i += 16)
    hits -= misses_of_block(key, i / 2);
  for (; i < end; ++i)
    hits -= miss(dart_number(key, i));
  return hits;
}

// Lab 2.6 -----------------------------------------------------------------------------------------

Sums sum_in_parallel(const Sampler& sampler, std::int64_t n, std::uint64_t seed, int threads) {
  const std::int64_t chunks = (n + chunk_samples - 1) / chunk_samples;
  std::vector<Sums> results(static_cast<std::size_t>(chunks));
  std::atomic<std::int64_t> next = 0;
  std::exception_ptr failure;
  std::mutex failure_mutex;

  const auto work = [&] {
    try {
      for (std::int64_t i = next++; i < chunks; i = next++) {
        carlo::Rng rng(seed, static_cast<std::uint64_t>(i));
        const std::int64_t count = std::min(chunk_samples, n - i * chunk_samples);
        results[static_cast<std::size_t>(i)] = sampler(count, rng);
      }
    } catch (...) {
      next = chunks;
      const std::lock_guard lock(failure_mutex);
      failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> team;  // joins when it goes out of scope
    for (std::int64_t i = 0; i < std::min<std::int64_t>(threads, chunks); ++i)
      team.emplace_back(work);
  }
  if (failure) std::rethrow_exception(failure);

  Sums total;
  for (const Sums& part : results) {
    total.count += part.count;
    total.sum += part.sum;
    total.squares += part.squares;
  }
  return total;
}

}  // namespace lab02
