#pragma once

#include <cstdint>
#include <vector>

namespace renderer {

/// Choices of a light for one point each: the random numbers, which light with what probability and
/// what remains of u; then the probability as it is computed for a light that is known.
struct LightChoices {
  std::vector<float> px, py, pz, nx, ny, nz, u;
  std::vector<std::uint32_t> word, light;
  std::vector<float> probability, again;
};

}  // namespace renderer
