#pragma once

#include "render/integrator.h"

#include <array>
#include <atomic>
#include <csignal>
#include <span>
#include <string>

namespace common_test {

/// An integrator without a scene: derived classes define a pixel's samples. It can simulate Ctrl-C.
class NoiseIntegrator : public carlo::Integrator {
 public:
  std::string name() const override { return "noise"; }

  void render(const carlo::Tile& tile, std::span<std::array<double, 3>> means,
              carlo::Counts& counts) const override {
    if (interrupt_at == ++calls) std::raise(SIGINT);
    std::size_t i = 0;
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        carlo::BlockSum sum;
        sample(tile, x, y, sum, counts);
        counts.paths += tile.samples;
        means[i++] = sum.mean(tile.samples);
      }
    }
  }

  int interrupt_at = -1;  ///< the call of render() that is interrupted; the first is 1
  mutable std::atomic<int> calls = 0;

 private:
  /// Adds the tile's samples of one of its pixels.
  virtual void sample(const carlo::Tile& tile, int x, int y, carlo::BlockSum& sum,
                      carlo::Counts& counts) const = 0;
};

}  // namespace common_test
