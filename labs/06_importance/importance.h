#pragma once

// Lab 06: importance sampling. The contract: what each exercise takes and returns. Do not edit this
// file; your work goes into importance.cpp.

#include "densities.h"
#include "random/rng.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lab06 {

/// Lab 6.1. The contribution of a point x drawn with density p to the estimate of f's integral: Y =
/// f(x) / p(x). 0 where p(x) is 0: such points have probability 0, but rounding hits them now and
/// then. Throws carlo::Error where p(x) is negative or NaN. Passes on an f(x) that is NaN.
double contribution(const Function& f, const Density& p, double x);

/// Lab 6.1. n >= 1 such contributions, in the order drawn, from exactly one rng.uniform() each.
std::vector<double> contributions(const Function& f, const Density& p, std::int64_t n,
                                  carlo::Rng& rng);

/// An estimate of an integral and its reliability.
struct Estimate {
  double value = 0;
  double variance = 0;        ///< of one contribution
  double standard_error = 0;  ///< of value
};

/// Lab 6.2. The estimate from contributions: their mean, the unbiased estimate of the variance of
/// one of them, and the standard error of their mean. Needs at least one number; for a single one,
/// variance and standard error are 0. No digits are lost where the mean is large compared with the
/// spread.
Estimate summarize(std::span<const double> values);

/// Lab 6.2. 1 / (variance x time), the inverse of the price of accuracy: samples with half the
/// variance at twice the time are equally efficient. variance >= 0, of one sample; seconds > 0, for
/// one sample. Infinite for variance 0.
double efficiency(double variance, double seconds);

/// Lab 6.3. The density on [a, b] that is proportional to 1 / (height^2 + t^2): the light that a
/// light `height` away from a ray throws on the ray's point t, counted from the point nearest to
/// the light. height > 0, a < b, both finite and of any sign. sample(u) grows with u, runs from a
/// to b and never leaves [a, b]; pdf is 0 outside. Source: Kulla and Fajardo, "Importance sampling
/// techniques for path tracing in participating media", EGSR 2012 (equiangular sampling).
Density light_density(double height, double a, double b);

/// Lab 6.4. The largest |value| as a fraction of the sum of all |values|; 0 if all are 0.
double largest_share(std::span<const double> values);

/// Lab 6.4. Hill's estimate of the tail index: the a in P(|Y| > y) ~ y^-a for large y, from the k
/// largest of the values. With m_0 >= m_1 >= ... the sizes |value| in descending order, a = k /
/// (log(m_0 / m_k) + ... + log(m_(k-1) / m_k)). 1 <= k < values.size(). Infinite where m_0 = m_k,
/// and where m_k = 0: then no tail is visible. The variance is infinite for a <= 2. Source: Hill,
/// "A simple general approach to inference about the tail of a distribution", 1975.
double tail_index(std::span<const double> values, std::size_t k);

/// Lab 6.4. The density that draws from p with probability `share`, 0 < share < 1, and from q
/// otherwise. One u decides both which and where: u < share is p's part. Each of the two is given a
/// number that is uniform on [0, 1), grows with u there, and is never 1.
Density mixture(const Density& p, const Density& q, double share);

/// Lab 6.5. Darts thrown for rejection samples of the shape g, used directly: one contribution per
/// dart; their mean estimates f's integral over the part of [a, b) where g > 0, without bias. g
/// need not be normalised; 0 <= g <= g_max. A dart draws x first, then y: exactly two
/// rng.uniform(). It is kept where y < g(x); only there f is evaluated. Throws carlo::Error when
/// g(x) is above g_max, negative or NaN. a < b, g_max > 0, darts >= 1.
std::vector<double> rejection_contributions(const Function& f, const Function& g, double a,
                                            double b, double g_max, std::int64_t darts,
                                            carlo::Rng& rng);

/// How much effort one technique spends on a point: the number of samples that it is given (or the
/// probability that it is the one chosen) and its pdf there. Both >= 0; the pdf may be infinite.
struct Effort {
  double samples = 0;
  double pdf = 0;
};

/// Lab 6.6. The weight of a sample that technique `own` drew where `other` might have drawn it too:
/// own's product samples x pdf as a fraction of both products (balance), or the same with the
/// products squared (power, exponent 2). In [0, 1], and right for products of any size: own's and
/// other's weights add up to 1 unless both products are 0. 0 if own's product is 0, whatever the
/// other's is; 1 if only the other's is 0. An infinite pdf takes all; the two are not both
/// infinite. Source: Veach and Guibas, "Optimally combining sampling techniques for Monte Carlo
/// rendering", SIGGRAPH 1995.
double balance_weight(Effort own, Effort other);
double power_weight(Effort own, Effort other);

/// One of the two above, or any other whose two weights add up to 1.
using Heuristic = double (*)(Effort own, Effort other);

/// A technique and its number of samples; the pdf of `density` is 0 where it never samples.
struct Technique {
  Density density;
  std::int64_t samples = 1;
};

/// Lab 6.7. f's integral from samples of both techniques, each weighted by the heuristic; unbiased
/// if at least one of those with samples covers f. Exactly one rng.uniform() per sample, first's
/// samples before second's. samples >= 0, not both 0. A sample whose own pdf is 0 contributes
/// nothing.
double multi_sample(const Function& f, const Technique& first, const Technique& second,
                    Heuristic heuristic, carlo::Rng& rng);

/// Lab 6.7. The same from a single sample: `first` is chosen with probability `share`, in [0, 1],
/// that is for u < share, otherwise `second`; u decides the point as well, as in Lab 6.4. The
/// result is one contribution: its expectation is the integral. The heuristic is given the
/// probabilities of being chosen as numbers of samples.
double one_sample(const Function& f, const Density& first, const Density& second, double share,
                  Heuristic heuristic, double u);

}  // namespace lab06
