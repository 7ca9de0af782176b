#pragma once

#include "bias.h"
#include "image/image.h"
#include "images/views.h"

#include <cstdint>
#include <span>

namespace lab09 {

// What the experiments of steps e and f share: photon maps made on all cores, a world whose light
// is mostly a caustic, and what the error of an image is made of.

/// Which photons a map is to hold.
enum class Kept { all, caustics };

/// The map of the photons of so many emitted, on one core.
PhotonMap photon_map(const World& world, std::int64_t emitted, Kept kept, Rng& rng);
/// The same on all cores, alike for any number of them.
PhotonMap photon_map(const World& world, std::int64_t emitted, Kept kept, std::uint64_t seed);

/// A ball of glass on a floor under a small round lamp.
carlo::Scene ball_of_glass();

/// Pixels that show the floor; the others stay black. What is seen in the ball, above all the lamp,
/// is as noisy by every method.
lab08::SampledPixel on_floor(const lab08::View& view, lab08::SampledPixel pixel);

/// bias^2 and variance of a pixel, on average over pixels and channels, in units of the square of
/// the reference's mean. The reference's own error is taken off the bias.
ErrorParts image_error(std::span<const carlo::Image> renders, const lab08::Reference& reference);

}  // namespace lab09
