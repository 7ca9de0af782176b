// A submission that sends its own answers in place of some probes': tables of the right shape,
// consistent with each other and with theory, for points that nobody drew. Everything else is the
// solution's work, so the points missing from full marks are those where the judge noticed.

#include "01_integration/integrands.h"
#include "grader/attacks/forge.h"
#include "grader/protocol/next_words.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

using namespace lab01_tests;
using carlo::grader::Params;
using carlo::grader::Rows;

namespace {

/// Number k of point i: well spread over [0, 1), and not random.
double spread(std::size_t i, std::size_t k) {
  return std::fmod(0.5 + static_cast<double>(i) * std::sqrt(2 + 3 * static_cast<double>(k)), 1.0);
}

/// n points of the box, one coordinate after the other.
std::vector<double> points(const Params& params, std::span<const double> lowest,
                           std::span<const double> highest) {
  std::vector<double> all;
  for (std::size_t i = 0; i < static_cast<std::size_t>(params.n); ++i) {
    for (std::size_t k = 0; k < lowest.size(); ++k)
      all.push_back(lowest[k] + (highest[k] - lowest[k]) * spread(i, k));
  }
  return all;
}

void append(Rows& rows, std::span<const double> values) {
  rows.values.insert(rows.values.end(), values.begin(), values.end());
}

/// The generator's next words, had the points been drawn.
void append_next_words(Rows& rows, const Params& params, std::size_t dimensions) {
  carlo::Rng rng(params.seed);
  for (std::size_t i = 0; i < static_cast<std::size_t>(params.n) * dimensions; ++i)
    rng.uniform();
  append(rows, carlo::grader::next_words(rng));
}

Rows record_on_line(const Params& params, double a, double b) {
  const std::vector<double> all = points(params, std::span(&a, 1), std::span(&b, 1));
  double sum = 0;
  for (const double x : all)
    sum += x * x;
  const auto n = static_cast<double>(params.n);
  Rows rows{1, {(b - a) * sum / n, n}};
  append_next_words(rows, params, 1);
  append(rows, all);
  return rows;
}

Rows record_in_box(const Params& params) {
  const auto d = static_cast<std::size_t>(params.whole("d"));
  std::vector<double> lowest, highest;
  double volume = 1, sum = 0;
  for (std::size_t i = 0; i < d; ++i) {
    lowest.push_back(lower(i));
    highest.push_back(upper(i));
    volume *= upper(i) - lower(i);
  }
  const std::vector<double> all = points(params, lowest, highest);
  for (std::size_t i = 0; i < all.size(); i += d)
    sum += evaluate(BoxIntegrand::squares, std::span(all).subspan(i, d));
  const auto n = static_cast<double>(params.n);
  Rows rows{1, {volume * sum / n, n}};
  append_next_words(rows, params, d);
  append(rows, all);
  return rows;
}

Rows record_in_domain(const Params& params) {
  const auto d = static_cast<std::size_t>(params.whole("d"));
  const auto n = static_cast<double>(params.n);
  const std::vector<double> all =
      points(params, std::span(domain_lower, d), std::span(domain_upper, d));
  std::vector<double> accepted;
  double volume = 1, sum = 0, squares = 0;
  for (std::size_t i = 0; i < d; ++i)
    volume *= domain_upper[i] - domain_lower[i];
  for (std::size_t i = 0; i < all.size(); i += d) {
    const auto x = std::span(all).subspan(i, d);
    if (!contains(static_cast<Domain>(params.whole("domain")), x)) continue;
    const double y = evaluate(static_cast<DomainIntegrand>(params.whole("integrand")), x);
    sum += y;
    squares += y * y;
    accepted.insert(accepted.end(), x.begin(), x.end());
  }
  const double variance = n > 1 ? (squares - sum * sum / n) / (n - 1) : 0;
  const auto known = static_cast<double>(accepted.size() / d);
  Rows rows{1, {volume * sum / n, volume * std::sqrt(variance / n), n, known}};
  append_next_words(rows, params, d);
  append(rows, all);
  accepted.resize(all.size(), std::nan(""));
  append(rows, accepted);
  return rows;
}

/// Moments that theory predicts for numbers 10 u v.
Rows likely_moments(const Params& params) {
  const auto n = static_cast<double>(params.n);
  const double variance = 100 * (1.0 / 9 - 1.0 / 16), error = std::sqrt(variance / n);
  return {4, {n, 2.5, variance, error, n, 2.5, variance, error}};
}

[[maybe_unused]] const bool forged = [] {
  const auto [probe, params] = carlo::grader::question();
  if (probe == "Lab 1.1 record") carlo::grader::forge(record_on_line(params, 0, 1));
  if (probe == "Lab 1.2 record")
    carlo::grader::forge(record_on_line(params, params["a"], params["b"]));
  if (probe == "Lab 1.3 drawn list") carlo::grader::forge(likely_moments(params));
  // 3 is the waves' mean, and 1 that of a side.
  if (probe == "Lab 1.4 drawn wave" || probe == "Lab 1.5 drawn wave")
    carlo::grader::forge({1, {3}});
  if (probe == "Lab 1.6 record") carlo::grader::forge(record_in_box(params));
  if (probe == "Lab 1.7 record") carlo::grader::forge(record_in_domain(params));
  return false;
}();

}  // namespace
