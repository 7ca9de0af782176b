#pragma once

#include "practice.h"

#include <cstdint>

namespace lab09 {

/// A scene by `samples` >= 2 of lab 08's paths a pixel, with what its pixels see: means over up to
/// 16 rays. Mirrors and glass have albedo 1 and their own normals. On all cores.
FeatureImage noisy_image(const PracticeScene& scene, int samples, std::uint64_t seed);

/// The same, each pixel by filter_pixel().
carlo::Image filtered_image(const FeatureImage& noisy, const FilterStrength& strength);

}  // namespace lab09
