#pragma once

#include "bias.h"
#include "image/image.h"
#include "images/views.h"

#include <cstdint>
#include <span>

namespace lab09 {

// Shared by the experiments of steps e and f: photon maps made on all cores, a world lit mostly by
// a caustic, and the parts of an image's error.

/// The photons that a map holds.
enum class Kept { all, caustics };

/// The map of the photons of `emitted` emitted ones, on one core.
PhotonMap photon_map(const World& world, std::int64_t emitted, Kept kept, Rng& rng);
/// The same on all cores, with the same result for any number of them.
PhotonMap photon_map(const World& world, std::int64_t emitted, Kept kept, std::uint64_t seed);

/// A ball of glass on a floor under a small round light.
carlo::Scene ball_of_glass();

/// The pixels that show the floor; the others stay black. What is seen in the ball, especially the
/// light, is equally noisy with every method.
lab08::SampledPixel on_floor(const lab08::View& view, lab08::SampledPixel pixel);

/// bias^2 and variance of a pixel, averaged over pixels and channels, in units of the square of the
/// reference's mean. The reference's own error is subtracted from the bias.
ErrorParts image_error(std::span<const carlo::Image> renders, const lab08::Reference& reference);

}  // namespace lab09
