#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace carlo::grader {

/// Returns the rate that `failures` in `trials` exclude with this confidence: the upper one-sided
/// bound of Clopper and Pearson ("The use of confidence or fiducial limits illustrated in the case
/// of the binomial", 1934). 1 without trials. Throws Error for more failures than trials.
double rate_upper_bound(std::size_t failures, std::size_t trials, double confidence = .95);

/// How p-values of correct solutions are distributed. `uniform`: no deviation found. `cautious`:
/// not uniform, but not too small, like those of exact tests, counts and bounds: they fail a
/// correct solution less often than they claim. `too_small`: they fail it more often.
enum class Behaviour { uniform, cautious, too_small };
std::string to_string(Behaviour behaviour);

struct Uniformity {
  std::size_t count = 0;
  double smallest = 1;
  double either_way = 1;  ///< Kolmogorov-Smirnov test against uniform
  double too_small = 1;   ///< one-sided test that they are smaller than uniform
  bool ties = false;      ///< equal values, which come only from discrete statistics

  /// Classifies at this level for both tests.
  Behaviour behaviour(double level) const;
};

/// Tests p-values for uniformity. NaN counts as 0.
Uniformity uniformity(std::vector<double> p_values);

}  // namespace carlo::grader
