#include "render/colour_scale.h"

#include <algorithm>
#include <array>

namespace carlo {
namespace {

constexpr std::array<std::array<float, 3>, 5> anchors = {{{0.005f, 0.005f, 0.04f},
                                                          {0.03f, 0.05f, 0.25f},
                                                          {0.25f, 0.05f, 0.25f},
                                                          {0.80f, 0.20f, 0.05f},
                                                          {1.00f, 0.85f, 0.30f}}};

}  // namespace

Rgb scale_colour(double t) {
  const double x = std::clamp(t, 0.0, 1.0) * (anchors.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), anchors.size() - 2);
  const auto f = static_cast<float>(x - static_cast<double>(i));
  Rgb c;
  for (int k = 0; k < 3; ++k) {
    const auto channel = static_cast<std::size_t>(k);
    c[k] = (1 - f) * anchors[i][channel] + f * anchors[i + 1][channel];
  }
  return c;
}

}  // namespace carlo
