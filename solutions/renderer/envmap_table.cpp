#include "renderer/envmap_table.h"

#include "image/image.h"
#include "numeric/robust.h"
#include "renderer/warp.h"

#include <algorithm>
#include <cmath>

namespace renderer {
namespace {

using carlo::Rgb;
using carlo::Vec2;
using carlo::Vec3;

constexpr float last_below_one = 0x1.fffffep-1f;

/// The running sums 0, w_0 / w, (w_0 + w_1) / w, ..., 1 as multiples of 2^-24, where w is the sum
/// of all weights; all 0 if w is 0.
std::vector<float> running_probabilities(const std::vector<double>& weights) {
  double whole = 0;
  for (const double w : weights)
    whole += w;
  std::vector<float> sums{0};
  double sum = 0;
  for (const double w : weights) {
    sum += w;
    sums.push_back(whole > 0 ? static_cast<float>(std::round(sum / whole * 0x1p24) * 0x1p-24)
                             : 0.0f);
  }
  return sums;
}

/// The step that contains u, of `count` steps from first[0] = 0 to first[count] = 1, and the
/// position of u within it.
struct Picked {
  std::size_t index;
  float within;
};
Picked step_of(const float* first, std::size_t count, float u) {
  const float* above = std::upper_bound(first, first + count, u);
  const float low = above[-1];
  return {static_cast<std::size_t>(above - first) - 1,
          std::min((u - low) / (*above - low), last_below_one)};
}

}  // namespace

EnvmapTable::EnvmapTable(const carlo::Envmap& of)
    : map(&of),
      rotation(of.rotation),
      width(static_cast<std::size_t>(of.image.width)),
      height(static_cast<std::size_t>(of.image.height)) {
  std::vector<std::vector<double>> luminances(height, std::vector<double>(width));
  std::vector<double> weights;
  for (std::size_t y = 0; y < height; ++y) {
    const double top = carlo::pi * static_cast<double>(y) / static_cast<double>(height),
                 bottom = carlo::pi * static_cast<double>(y + 1) / static_cast<double>(height);
    const bool north = 2 * y < height;
    // 1 - cos(x) = 2 sin^2(x / 2), where x is the angle from the pole.
    const auto from_pole = [north](double theta) {
      const double sine = std::sin((north ? theta : carlo::pi - theta) / 2);
      return static_cast<float>(2 * sine * sine);
    };
    upper.push_back(from_pole(top));
    lower.push_back(from_pole(bottom));
    pole.push_back(north ? 1.0f : -1.0f);
    const double solid_angle = 4 * carlo::pi / static_cast<double>(width) *
                               std::sin((top + bottom) / 2) * std::sin((bottom - top) / 2);
    double sum = 0;
    for (std::size_t x = 0; x < width; ++x) {
      const Rgb c = of.image.pixels[y * width + x];
      sum += luminances[y][x] = carlo::luminance({c.r, c.g, c.b});
      brightness += solid_angle * (static_cast<double>(c.r) + static_cast<double>(c.g) +
                                   static_cast<double>(c.b));
    }
    weights.push_back(sum * solid_angle);
  }
  rows = running_probabilities(weights);
  for (std::size_t y = 0; y < height; ++y)
    add_row(y, static_cast<double>(rows[y + 1]) - static_cast<double>(rows[y]), luminances[y]);
}

/// The solid angle lies between the rounded edges, since sampling uses those.
void EnvmapTable::add_row(std::size_t y, double probability,
                          const std::vector<double>& luminances) {
  const std::vector<float> sums = running_probabilities(luminances);
  columns.insert(columns.end(), sums.begin(), sums.end());
  const double solid_angle =
      2 * carlo::pi / static_cast<double>(width) *
      std::abs(static_cast<double>(lower[y]) - static_cast<double>(upper[y]));
  for (std::size_t x = 0; x < width; ++x) {
    const Rgb c = map->image.pixels[y * width + x];
    const double share = static_cast<double>(sums[x + 1]) - static_cast<double>(sums[x]);
    texels.push_back({c.r, c.g, c.b, static_cast<float>(probability * share / solid_angle)});
  }
}

EnvmapTable::Sample EnvmapTable::sample(Vec2 u) const {
  const Picked row = step_of(rows.data(), height, u.y);
  const std::size_t y = row.index;
  const Picked column = step_of(columns.data() + y * (width + 1), width, u.x);
  const float h = upper[y] + row.within * (lower[y] - upper[y]);
  const float sine = carlo::safe_sqrt(h * (2 - h));
  const Vec2 around =
      on_circle((static_cast<float>(column.index) + column.within) / static_cast<float>(width));
  const Vec3 own(sine * around.y, pole[y] * (1 - h), -sine * around.x);
  const auto& [r, g, b, pdf] = texels[y * width + column.index];
  return {rotation * own, Rgb(r, g, b), pdf};
}

EnvmapTable::Texel EnvmapTable::at(Vec3 d) const {
  const auto& [r, g, b, pdf] = texels[carlo::texel_at(*map, d)];
  return {Rgb(r, g, b), pdf};
}

}  // namespace renderer
