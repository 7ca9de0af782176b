#include "goodness.h"

#include "numeric/robust.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lab07 {
namespace {

constexpr int rings = 40, sectors = 24;

Vec3 direction(double z, double phi) {
  const double sine = std::sqrt(std::max(1 - z * z, 0.0));
  return {sine * std::cos(phi), sine * std::sin(phi), z};
}

/// The integral of the density over one cell, by Gauss's rule of three points in both coordinates
/// of four parts.
double mass(const Pdf& pdf, int ring, int sector) {
  constexpr double places[] = {-0.7745966692414834, 0, 0.7745966692414834};
  constexpr double weights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  constexpr int parts = 2;
  const double height = 2.0 / (rings * parts), width = 2 * carlo::pi / (sectors * parts);
  double sum = 0;
  for (int k = 0; k < parts * parts; ++k) {
    const int row = k / parts, column = k % parts;
    const double z0 = -1 + height * (parts * ring + row + 0.5);
    const double phi0 = width * (parts * sector + column + 0.5);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        sum += weights[i] * weights[j] *
               pdf(direction(z0 + places[i] * height / 2, phi0 + places[j] * width / 2));
      }
    }
  }
  return sum * height * width;
}

int cell_of(Vec3 w) {
  const int ring = std::clamp(static_cast<int>((w.z + 1) / 2 * rings), 0, rings - 1);
  const double turn = std::atan2(w.y, w.x) / (2 * carlo::pi);
  const int sector = static_cast<int>((turn < 0 ? turn + 1 : turn) * sectors);
  return ring * sectors + std::min(sector, sectors - 1);
}

}  // namespace

Goodness goodness(std::span<const Vec3> directions, const Pdf& pdf) {
  const auto total = static_cast<double>(directions.size());
  std::vector<double> counts(rings * sectors);
  for (const Vec3 w : directions) {
    if (!(pdf(w) > 0)) return carlo::no_fit();
    counts[static_cast<std::size_t>(cell_of(w))] += 1;
  }
  std::vector<double> expected;
  for (int cell = 0; cell < rings * sectors; ++cell)
    expected.push_back(total * mass(pdf, cell / sectors, cell % sectors));
  return carlo::pooled_goodness(counts, expected);
}

double density_of_height(const Pdf& pdf, double z) {
  double sum = 0;
  for (int k = 0; k < 96; ++k)
    sum += pdf(direction(z, 2 * carlo::pi * (k + 0.5) / 96));
  return sum * 2 * carlo::pi / 96;
}

}  // namespace lab07
