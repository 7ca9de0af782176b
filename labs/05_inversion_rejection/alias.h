#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lab05 {

/// For comparison with Lab 5.4: numbers 0 ... n-1 with probabilities proportional to weights, with
/// one look-up per draw whatever n is. Bin i of n equal ones holds a piece of number i and a piece
/// of one other, its alias. u is cut up and rearranged: unlike an inverse CDF the result does not
/// grow with u, so stratified u do not give stratified numbers. Source: M. D. Vose, "A linear
/// algorithm for generating random numbers with a given distribution", 1991; the idea is A. J.
/// Walker's, 1974. Weights: finite, >= 0, sum > 0.
class Alias {
 public:
  explicit Alias(std::span<const double> weights) : bins_(weights.size()) {
    double sum = 0;
    for (const double weight : weights)
      sum += weight;
    std::vector<double> share(weights.size());  // 1 on average
    std::vector<std::uint32_t> small, large;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      share[i] = weights[i] / sum * static_cast<double>(weights.size());
      (share[i] < 1 ? small : large).push_back(static_cast<std::uint32_t>(i));
    }
    while (!small.empty() && !large.empty()) {
      const std::uint32_t poor = small.back(), rich = large.back();
      small.pop_back();
      bins_[poor] = {share[poor], rich};
      share[rich] -= 1 - share[poor];
      if (share[rich] >= 1) continue;
      large.pop_back();
      small.push_back(rich);
    }
    // Bins that rounding left over are full.
    for (const auto* rest : {&small, &large}) {
      for (const std::uint32_t i : *rest)
        bins_[i] = {1, i};
    }
  }

  /// 0 <= u < 1.
  std::size_t sample(double u) const {
    const double place = u * static_cast<double>(bins_.size());
    const auto bin = static_cast<std::size_t>(place);
    return place - std::floor(place) < bins_[bin].share ? bin : bins_[bin].other;
  }

 private:
  struct Bin {
    double share = 1;         ///< fraction of this bin that is the bin's own number;
    std::uint32_t other = 0;  ///< the rest belongs to this one
  };
  std::vector<Bin> bins_;
};

}  // namespace lab05
