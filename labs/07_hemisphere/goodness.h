#pragma once

#include "hemisphere.h"
#include "stats/goodness.h"

#include <functional>
#include <span>

namespace lab07 {

using carlo::Goodness;

/// A density on the sphere.
using Pdf = std::function<double(Vec3)>;

/// Counts directions in cells of the whole sphere, rings of equal height by sectors of equal
/// azimuth, and compares them with the integrals of the density over the cells. Neighbouring cells
/// are pooled until 100 directions are expected in each. Directions where the density is 0 make p =
/// 0.
Goodness goodness(std::span<const Vec3> directions, const Pdf& pdf);

/// The density of z = cos(theta): the mean over the azimuth, times 2 pi.
double density_of_height(const Pdf& pdf, double z);

}  // namespace lab07
