// Lab 5: a density inverted and rejected, with the cost of each.

#include "alias.h"
#include "bins.h"
#include "call.h"
#include "inversion_rejection.h"

#include <algorithm>

namespace site {
namespace {

using namespace lab05;

/// way (0 inversion, 1 rejection, 2 alias), n, seed, weights of the bins: how many samples fall
/// into each bin, then the number of darts.
Numbers histogram(const Arguments& given) {
  const std::span<const double> weights = given.from(3);
  const std::int64_t n = given.whole(1), way = given.whole(0);
  const double most = *std::max_element(weights.begin(), weights.end());
  carlo::Rng rng = given.rng(2, 1);
  Numbers counts(weights.size() + 1);
  const auto count = [&](double x) { counts[bin_of(x, weights.size())] += 1; };
  if (way == 0) {
    const Tabulated1d table(weights);
    for (std::int64_t i = 0; i < n; ++i)
      count(table.sample(rng.uniform()));
  } else if (way == 1) {
    const auto f = [&](double x) { return weights[bin_of(x, weights.size())]; };
    for (std::int64_t i = 0; i < n; ++i) {
      const Accepted<double> accepted = sample_by_rejection(f, 0, 1, most, rng);
      count(std::min(accepted.value, 0x1.fffffffffffffp-1));
      counts.back() += static_cast<double>(accepted.darts);
    }
  } else {
    const Alias alias(weights);
    for (std::int64_t i = 0; i < n; ++i)
      counts[alias.sample(rng.uniform())] += 1;
  }
  return counts;
}

/// weights: the share of darts that rejection accepts.
Numbers accepted(const Arguments& given) {
  const std::span<const double> weights = given.from(0);
  double sum = 0;
  for (const double weight : weights)
    sum += weight / static_cast<double>(weights.size());
  return {acceptance_rate(sum, 0, 1, *std::max_element(weights.begin(), weights.end()))};
}

/// way (0 inversion, 1 rejection), exponent, n, runs, seed: the RMS error of the mean of samples of
/// the density (e + 1) x^e, and the darts per sample.
Numbers power(const Arguments& given) {
  const double exponent = given[1];
  carlo::Rng rng = given.rng(4, 2);
  double darts = 0;
  const auto f = [exponent](double x) { return std::pow(x, exponent); };
  const auto trial = [&] {
    double sum = 0;
    for (std::int64_t i = 0; i < given.whole(2); ++i) {
      if (given[0] == 0) {
        sum += sample_power(rng.uniform(), exponent);
        continue;
      }
      const Accepted<double> accepted = sample_by_rejection(f, 0, 1, 1, rng);
      sum += accepted.value;
      darts += static_cast<double>(accepted.darts);
    }
    return sum / given[2];
  };
  const double error = rms_error(given.whole(3), (exponent + 1) / (exponent + 2), trial);
  return {error, given[0] == 0 ? 1 : darts / given[2] / given[3]};
}

/// way (0 rejection, 1 inversion, 2 inversion of jittered numbers), side, seed: side^2 points of
/// the unit disc, as x, y pairs; then the darts.
Numbers disc(const Arguments& given) {
  const std::int64_t side = given.whole(1);
  carlo::Rng rng = given.rng(2, 1);
  Numbers results;
  double darts = 0;
  for (std::int64_t i = 0; i < side * side; ++i) {
    Point p;
    if (given[0] == 0) {
      const Accepted<Point> accepted = disc_by_rejection(rng);
      p = accepted.value;
      darts += static_cast<double>(accepted.darts);
    } else {
      double radius = rng.uniform(), angle = rng.uniform();
      if (given[0] == 2) {
        const auto row = i / side, column = i % side;
        radius = (static_cast<double>(column) + radius) / given[1];
        angle = (static_cast<double>(row) + angle) / given[1];
      }
      p = disc_by_inversion(radius, angle);
      darts += 1;
    }
    results.insert(results.end(), {p.x, p.y});
  }
  results.push_back(darts);
  return results;
}

/// way as above, side, runs, seed: the RMS error of the disc's mean of x^2, 1/4, over side^2
/// points.
Numbers disc_error(const Arguments& given) {
  double call = 0;
  const auto trial = [&] {
    const double numbers[] = {given[0], given[1], given[3] + 1000 * call++};
    const Numbers xy = disc(Arguments(numbers));
    double sum = 0;
    for (std::size_t i = 0; i + 1 < xy.size(); i += 2)
      sum += xy[i] * xy[i];
    return sum / (given[1] * given[1]);
  };
  return {rms_error(given.whole(2), 0.25, trial)};
}

const Function functions[] = {{"5.histogram", histogram},
                              {"5.accepted", accepted},
                              {"5.power", power},
                              {"5.disc", disc},
                              {"5.disc_error", disc_error}};

}  // namespace
}  // namespace site
