#pragma once

#include "renderer/production/adaptive_state.h"

#include <cstddef>

// Decides when the pixels of an adaptive render are finished (adaptive.h).

namespace carlo {

/// Returns the luminance below which errors are relative to it instead of the pixel: 1 % of the
/// image's mean, estimated from the halves [begin, end).
double adaptive_floor(const AdaptiveState& state, std::size_t begin, std::size_t end);

/// Sets the floors from the first round: each half's from its own samples, or the halves would not
/// be independent.
void set_floors(AdaptiveState& state);

/// Makes the decisions after a round: each half of each active unit decides whether the other is
/// finished. It may use only the samples of the same half of other units from before their
/// decisions, so that decisions remain functions of that half's samples alone. Returns the
/// approximate number of samples still missing.
double decide_round(AdaptiveState& state, double target, const Levels& levels);

}  // namespace carlo
