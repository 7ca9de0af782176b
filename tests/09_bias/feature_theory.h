#pragma once

#include "09_bias/feature_data.h"

#include <algorithm>
#include <cmath>

// The weights and means of Lab 9.3, and the results of mistakes.

namespace lab09_features {

inline double real(float x) {
  return static_cast<double>(x);
}

inline double apart2(const Three& a, const Three& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    sum += (real(a[i]) - real(b[i])) * (real(a[i]) - real(b[i]));
  return sum;
}

/// The terms of a weight's exponent, as in the contract.
struct Terms {
  double albedo, normal, depth, color;
  double weight() const { return std::exp(-(albedo + normal + depth + color)); }
};

inline double relative_depth(const Pixel& a, const Pixel& b) {
  const double larger = std::max(real(a.depth), real(b.depth));
  return larger > 0 ? (real(a.depth) - real(b.depth)) / larger : 0;
}

/// Sums a mistake's colour distances over the channels, from apart = c - c' and the variances.
template <class Channel>
double color_sum(const Pair& p, const Channel& channel) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    sum += channel(real(p.one.color[c]) - real(p.other.color[c]), real(p.one.variance[c]),
                   real(p.other.variance[c]));
  }
  return sum;
}

inline double color_term(const Pair& p) {
  const double k2 = p.strength.color * p.strength.color;
  return color_sum(p,
                   [k2](double apart, double v, double w) {
                     if (v + w == 0) return apart == 0 ? 0.0 : INFINITY;
                     return std::max(0.0, apart * apart - (v + w)) / (k2 * (v + w));
                   }) /
         3;
}

inline Terms terms_of(const Pair& p) {
  const double part = relative_depth(p.one, p.other);
  return {apart2(p.one.albedo, p.other.albedo) / (2 * p.strength.albedo * p.strength.albedo),
          apart2(p.one.normal, p.other.normal) / (2 * p.strength.normal * p.strength.normal),
          part * part / (2 * p.strength.depth * p.strength.depth), color_term(p)};
}

/// The pixels of a window with their weights relative to the middle one.
struct WindowSums {
  double weights = 0, squares = 0;
  std::array<double, 3> color{}, variance{}, variance_once{};

  void add(const Pixel& pixel, double w) {
    weights += w;
    squares += w * w;
    for (std::size_t c = 0; c < 3; ++c) {
      color[c] += w * real(pixel.color[c]);
      variance[c] += w * w * real(pixel.variance[c]);
      variance_once[c] += w * real(pixel.variance[c]);
    }
  }
};

/// The pixels up to `across` and `down` away; `edge`: what replaces those outside the image.
enum class Edge { cut, repeated, wrapped };
inline WindowSums window_sums(const PixelImage& image, int x, int y, int across, int down,
                              Edge edge = Edge::cut, bool with_middle = true) {
  WindowSums sums;
  const auto place = [edge](int i, int size) {
    if (edge == Edge::repeated) return std::clamp(i, 0, size - 1);
    if (edge == Edge::wrapped) return (i % size + size) % size;
    return i;
  };
  for (int dy = -down; dy <= down; ++dy) {
    for (int dx = -across; dx <= across; ++dx) {
      const int at_x = place(x + dx, image.width), at_y = place(y + dy, image.height);
      if (at_x < 0 || at_x >= image.width || at_y < 0 || at_y >= image.height) continue;
      if (!with_middle && dx == 0 && dy == 0) continue;
      const Pixel& other = image.at(at_x, at_y);
      sums.add(other, terms_of({image.at(x, y), other, image.strength}).weight());
    }
  }
  return sums;
}

}  // namespace lab09_features
