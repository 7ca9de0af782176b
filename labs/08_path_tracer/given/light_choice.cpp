#include "given/light_choice.h"

#include "support/error.h"

#include <algorithm>
#include <cmath>

namespace lab08 {
namespace {

constexpr double steps = 0x1p24;

}  // namespace

LightChoice::LightChoice(std::span<const LightWeight> weights) {
  double power = 0;
  for (const LightWeight& weight : weights) {
    if (weight.share > 0 && weight.share < 0x1p-22) {
      throw carlo::Error(
          "lab 8 chooses among up to 4194304 lights: too many shapes emit, or a mesh that emits has "
          "too many triangles");
    }
    power += weight.power;
  }
  const bool by_power = power > 0 && std::isfinite(power);
  double sum = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const LightWeight& weight = weights[i];
    if (weight.share > 0) {
      sum += by_power ? (weight.power / power + weight.share) / 2 : weight.share;
      last = i;
    }
    below_.push_back(static_cast<std::uint32_t>(std::lround(std::min(sum, 1.0) * steps)));
  }
  // Rounding may have left a few steps over or not: they go to the last light with a nonzero
  // probability.
  std::fill(below_.begin() + static_cast<std::ptrdiff_t>(last), below_.end(),
            static_cast<std::uint32_t>(steps));
}

std::size_t LightChoice::operator()(double u) const {
  const auto step = static_cast<std::uint32_t>(u * steps);
  const auto above = std::upper_bound(below_.begin(), below_.end(), step);
  return static_cast<std::size_t>(above - below_.begin());
}

float LightChoice::chance(std::size_t i) const {
  const std::uint32_t before = i == 0 ? 0 : below_[i - 1];
  return static_cast<float>(below_[i] - before) / static_cast<float>(steps);
}

}  // namespace lab08
