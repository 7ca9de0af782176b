#pragma once

#include "numeric/vec.h"

#include <cstddef>
#include <vector>

namespace lab09 {

using carlo::Rgb;
using carlo::Vec3;

/// A pixel of a noisy image and the features that the camera sees there.
struct FeaturePixel {
  Rgb color{0};     ///< the mean of its samples
  Rgb variance{0};  ///< of that mean: its standard error squared
  Rgb albedo{0};
  Vec3 normal{0};
  float depth = 0;  ///< distance from the camera; 0 where nothing is hit
};

class FeatureImage {
 public:
  FeatureImage(int width, int height)
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  int width() const { return width_; }
  int height() const { return height_; }
  FeaturePixel& at(int x, int y) { return pixels_.at(index(x, y)); }
  const FeaturePixel& at(int x, int y) const { return pixels_.at(index(x, y)); }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_, height_;
  std::vector<FeaturePixel> pixels_;
};

}  // namespace lab09
