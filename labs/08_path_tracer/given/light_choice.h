#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lab08 {

/// The weight of a light when one of all is chosen.
struct LightWeight {
  double power = 0;  ///< >= 0
  double share = 0;  ///< share of the choices made regardless of power; 0: the light is never
                     ///< chosen
};

/// Chooses one of the numbers 0 ... n-1: with probability 1/2 by power, otherwise by the shares. By
/// power alone a weak light beside you would never be chosen in a world with a far, strong sun, and
/// an error bar does not know about samples that were never drawn. All probabilities are whole
/// multiples of 2^-24, the step of Rng::uniform_float(): each number is drawn exactly as often as
/// chance() says, however rarely.
class LightChoice {
 public:
  LightChoice() = default;
  /// The shares add up to 1. Throws carlo::Error if one of them is above 0 and below 2^-22:
  /// rounding could leave it without a step.
  explicit LightChoice(std::span<const LightWeight> weights);

  /// 0 <= u < 1. As in Lab 5.4, with whole numbers for the CDF.
  std::size_t operator()(double u) const;
  float chance(std::size_t i) const;

 private:
  std::vector<std::uint32_t> below_;  ///< below_[i]: the number of steps that belong to 0 ... i
};

}  // namespace lab08
