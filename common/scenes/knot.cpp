#include "scenes/knot.h"

#include "numeric/vec.h"
#include "support/atomic_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

namespace carlo {
namespace {

using Vec = glm::dvec3;
constexpr double turn = 2 * std::numbers::pi;

/// The tube's axis: it goes twice around the z axis and three times around a ring.
Vec axis(double t) {
  const double ring = 1 + 0.45 * std::cos(3 * turn * t);
  return {ring * std::cos(2 * turn * t), ring * std::sin(2 * turn * t),
          0.45 * std::sin(3 * turn * t)};
}

/// A point of the surface: t along the tube, s around it, both with period 1.
Vec surface(double t, double s) {
  constexpr double step = 1e-4;
  const Vec centre = axis(t);
  const Vec along = glm::normalize(axis(t + step) - axis(t - step));
  const Vec side = glm::normalize(glm::cross(along, centre));
  const Vec up = glm::cross(side, along);
  const double r = 0.23 + 0.02 * std::cos(turn * (8 * s + 20 * t));
  const double a = r * std::cos(turn * s), b = r * std::sin(turn * s);
  return centre + a * side + b * up;
}

/// The unit normal, outwards.
Vec normal(double t, double s) {
  constexpr double step = 1e-4;
  return glm::normalize(glm::cross(surface(t, s + step) - surface(t, s - step),
                                   surface(t + step, s) - surface(t - step, s)));
}

template <class T>
void append(std::string& bytes, T value) {
  static_assert(std::endian::native == std::endian::little);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// In steps far above the rounding of sin and cos, so that every machine writes the same file.
void append(std::string& bytes, const Vec& v) {
  for (int i = 0; i < 3; ++i)
    append(bytes, static_cast<float>(std::round(v[i] * 0x1p20) * 0x1p-20));
}

void append(std::string& bytes, const std::array<int, 3>& triangle) {
  append(bytes, std::uint8_t{3});
  for (const int corner : triangle)
    append(bytes, static_cast<std::int32_t>(corner));
}

}  // namespace

void write_knot(const std::filesystem::path& file, int triangles) {
  // Five times as many along the tube as around it make them about equilateral.
  const int around = std::max(7, static_cast<int>(std::sqrt(triangles / 10.0)));
  const int along = std::max(42, triangles / (2 * around));
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\n"
      "property float y\nproperty float z\nproperty float nx\nproperty float ny\n"
      "property float nz\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      along * around, 2 * along * around);
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) {
      const double t = static_cast<double>(i) / along, s = static_cast<double>(j) / around;
      append(bytes, surface(t, s));
      append(bytes, normal(t, s));
    }
  }
  const auto corner = [&](int i, int j) { return i % along * around + j % around; };
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) {
      append(bytes, std::array{corner(i, j), corner(i, j + 1), corner(i + 1, j + 1)});
      append(bytes, std::array{corner(i, j), corner(i + 1, j + 1), corner(i + 1, j)});
    }
  }
  write_file(file, bytes);
}

}  // namespace carlo
