#pragma once

#include "renderer/production/adaptive_state.h"

#include <cstddef>

// What an adaptive render makes of its samples: when is a pixel done? (adaptive.h)

namespace carlo {

/// The luminance below which errors are relative to it: 1 % of the image's mean, as the halves
/// [begin, end) see it.
double adaptive_floor(const AdaptiveState& state, std::size_t begin, std::size_t end);

/// From the first round, each half for itself: else the halves would not be independent.
void set_floors(AdaptiveState& state);

/// After a round: each half of each active unit looks whether the other is finished. Only what the
/// same half of other units saw before their decisions counts besides, so that decisions stay
/// functions of that half's samples alone. Returns about how many samples are missing still.
double decide_round(AdaptiveState& state, double target, const Levels& levels);

}  // namespace carlo
