#pragma once

#include "image/image.h"

#include <vector>

namespace carlo {

/// The perceived difference of two images, pixel by pixel, for a viewer who flips between them on a
/// screen: 0 identical, 1 as different as possible. Linear RGB, clipped to [0, 1] as on a screen;
/// NaN counts as 0. `pixels_per_degree`: pixels per degree of the field of view, 67 for a screen of
/// 3840 pixels, 0.7 m wide, seen from 0.7 m. Throws Error when the sizes differ. Source: Andersson
/// et al., "FLIP: A Difference Evaluator for Alternating Images", Proceedings of the ACM on
/// Computer Graphics and Interactive Techniques 3(2), 2020.
std::vector<float> flip_map(const Image& image, const Image& reference,
                            double pixels_per_degree = 67.0206);

/// The mean of a map; NaN for an empty one.
double mean_flip(const std::vector<float>& map);

}  // namespace carlo
