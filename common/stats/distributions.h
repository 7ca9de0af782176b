#pragma once

#include <cstddef>

namespace carlo {

/// Tail probabilities for tests. All keep their relative accuracy far out, where 1 - cdf would
/// round to 0. NaN arguments give NaN.

/// Returns P(|Z| >= |z|) for a standard normal Z.
double normal_two_sided(double z);

/// Returns the z > 0 with P(|Z| >= z) = p, for 0 < p <= 1. Throws std::domain_error outside.
double normal_two_sided_quantile(double p);

/// Return P(X <= x) and P(X >= x) for chi-square with 0 < dof <= 2e12 degrees of freedom, x >= 0;
/// dof need not be whole. NaN outside, which passes no comparison with a level.
double chi_square_lower(double x, double dof);
double chi_square_upper(double x, double dof);

/// Return the x with P(X <= x) = p, and with P(X >= x) = p, for 0 <= p < 1 (0 < p <= 1). Throw
/// std::domain_error outside.
double chi_square_lower_quantile(double p, double dof);
double chi_square_upper_quantile(double p, double dof);

/// Returns the noncentrality for which a noncentral chi-square variable is <= x with probability p
/// < 1; for a central one that probability is larger. Throws std::domain_error outside.
double chi_square_noncentrality(double x, double dof, double p);

/// Two-sided: twice the smaller tail, at most 1.
double chi_square_two_sided(double x, double dof);

/// Returns P(D >= d) for the Kolmogorov-Smirnov distance of n independent values from their true
/// continuous distribution. If below .27, twice the one-sided probability, which counts deviations
/// beyond d on both sides twice, an error of at most .1 %; above, the asymptotic series with
/// Stephens' correction for finite n (M. A. Stephens, "Use of the Kolmogorov-Smirnov, Cramer-von
/// Mises and related statistics without extensive tables", 1970). Accurate to 2 per cent for n >=
/// 100.
double kolmogorov_smirnov(double d, std::size_t n);

/// Returns P(D+ >= d) for the greatest excess of the empirical distribution function over the true
/// one. Exact up to n = 20 000 (Birnbaum and Tingey, "One-sided confidence contours for probability
/// distribution functions", 1951); above, exp(-(6 n d + 1)^2 / (18 n)) (Maag and Dicaire, 1971).
double one_sided_kolmogorov_smirnov(double d, std::size_t n);

/// Returns the level for each of `count` independent tests so that all together reject a true
/// hypothesis with probability alpha: 1 - (1 - alpha)^(1/count) (Sidak 1967).
double sidak(double alpha, std::size_t count);

}  // namespace carlo
