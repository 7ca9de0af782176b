// Lab 2: darts at a circle, and intervals that hold or not.

#include "call.h"
#include "pi.h"

#include <cmath>
#include <numbers>

namespace site {
namespace {

using namespace lab02;
using std::numbers::pi;

/// seed, n: where the first n darts of throw_darts() fall, as x, y pairs.
Numbers places(const Arguments& given) {
  carlo::Rng rng = given.rng(0, 1);
  Numbers xy(2 * given.index(1));
  for (double& coordinate : xy)
    coordinate = rng.uniform();
  return xy;
}

/// estimator (0 darts, 1 circle, 2 arctangent), N, runs, seed: the RMS error, and the last run's
/// estimate and standard error.
Numbers estimates(const Arguments& given) {
  carlo::Rng rng = given.rng(3, 1);
  const std::int64_t n = given.whole(1);
  Estimate last;
  const auto trial = [&] {
    switch (given.whole(0)) {
      case 0:
        last = pi_estimate(throw_darts(n, rng));
        break;
      case 1:
        last = mean_of(sum_circle(n, rng));
        break;
      default:
        last = mean_of(sum_arctangent(n, rng));
    }
    return last.value;
  };
  const double error = rms_error(given.whole(2), pi, trial);
  return {error, last.value, last.standard_error};
}

Numbers deviations(const Arguments&) {
  return {darts_deviation(), circle_deviation(), arctangent_deviation()};
}

/// The interval of each kind: estimate -+ z standard errors, and Wilson's.
struct Both {
  Interval simple, score;
};

Both intervals_of(const Darts& darts, double z) {
  const Estimate e = pi_estimate(darts);
  return {{e.value - z * e.standard_error, e.value + z * e.standard_error}, pi_interval(darts, z)};
}

bool holds(const Interval& interval, double value) {
  return interval.lower <= value && value <= interval.upper;
}

/// N, z, runs, seed: the shares of simple and of score intervals that hold pi; then the bounds of
/// each run's two intervals.
Numbers intervals(const Arguments& given) {
  carlo::Rng rng = given.rng(3, 0);
  Numbers results(2);
  for (std::int64_t i = 0; i < given.whole(2); ++i) {
    const Both both = intervals_of(throw_darts(given.whole(0), rng), given[1]);
    results[0] += holds(both.simple, pi) ? 1 / given[2] : 0;
    results[1] += holds(both.score, pi) ? 1 / given[2] : 0;
    results.insert(results.end(),
                   {both.simple.lower, both.simple.upper, both.score.lower, both.score.upper});
  }
  return results;
}

/// N, z: the probabilities that either interval holds pi, by the sum over all numbers of hits.
Numbers coverage(const Arguments& given) {
  const double n = given[0], hit = pi / 4;
  Numbers results(2);
  for (std::int64_t k = 0; k <= given.whole(0); ++k) {
    const auto hits = static_cast<double>(k);
    const double chance =
        std::exp(std::lgamma(n + 1) - std::lgamma(hits + 1) - std::lgamma(n - hits + 1) +
                 hits * std::log(hit) + (n - hits) * std::log1p(-hit));
    const Both both = intervals_of({given.whole(0), k}, given[1]);
    results[0] += holds(both.simple, pi) ? chance : 0;
    results[1] += holds(both.score, pi) ? chance : 0;
  }
  return results;
}

const Function functions[] = {{"2.places", places},
                              {"2.estimates", estimates},
                              {"2.deviations", deviations},
                              {"2.intervals", intervals},
                              {"2.coverage", coverage}};

}  // namespace
}  // namespace site
