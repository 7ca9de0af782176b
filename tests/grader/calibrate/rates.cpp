#include "grader/calibrate/rates.h"

#include "stats/distributions.h"
#include "support/error.h"

#include <boost/math/special_functions/beta.hpp>

#include <algorithm>
#include <cmath>

namespace carlo::grader {

double rate_upper_bound(std::size_t failures, std::size_t trials, double confidence) {
  if (failures > trials) throw Error("{} failures of {} trials", failures, trials);
  if (failures == trials) return 1;
  const auto k = static_cast<double>(failures), n = static_cast<double>(trials);
  return boost::math::ibeta_inv(k + 1, n - k, confidence);
}

std::string to_string(Behaviour behaviour) {
  switch (behaviour) {
    case Behaviour::uniform:
      return "uniform";
    case Behaviour::cautious:
      return "cautious";
    case Behaviour::too_small:
      return "too small";
  }
  throw Error("unknown behaviour");
}

Behaviour Uniformity::behaviour(double level) const {
  if (!(too_small >= level)) return Behaviour::too_small;
  return either_way >= level ? Behaviour::uniform : Behaviour::cautious;
}

Uniformity uniformity(std::vector<double> p_values) {
  for (double& p : p_values)
    p = std::isnan(p) ? 0 : p;
  std::sort(p_values.begin(), p_values.end());
  Uniformity result;
  result.count = p_values.size();
  if (p_values.empty()) return result;
  result.smallest = p_values.front();
  result.ties = std::adjacent_find(p_values.begin(), p_values.end()) != p_values.end();
  const auto n = static_cast<double>(p_values.size());
  double above = 0, below = 0, rank = 0;
  for (const double p : p_values) {
    below = std::max(below, p - rank / n);
    rank += 1;
    above = std::max(above, rank / n - p);
  }
  result.either_way = kolmogorov_smirnov(std::max(above, below), p_values.size());
  result.too_small = one_sided_kolmogorov_smirnov(above, p_values.size());
  return result;
}

}  // namespace carlo::grader
