#pragma once

#include "practice.h"

#include <cstdint>

namespace lab09 {

/// Renders a scene with `samples` >= 2 of lab 8's paths per pixel, with the features of its
/// pixels: means over up to 16 rays. Mirrors and glass have albedo 1 and their own normals. Runs on
/// all cores.
FeatureImage noisy_image(const PracticeScene& scene, int samples, std::uint64_t seed);

/// The same, with each pixel filtered by filter_pixel().
carlo::Image filtered_image(const FeatureImage& noisy, const FilterStrength& strength);

}  // namespace lab09
