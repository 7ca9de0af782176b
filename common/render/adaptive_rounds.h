#pragma once

#include "render/adaptive_state.h"

#include <cstdint>

// A round of an adaptive render (adaptive.h) that several share. Each goes on from the same state
// with a share of the round's jobs (AdaptiveOptions::share); what they add is put together, and the
// decisions behind the round are those of one that did all of it, bit for bit: a pixel's half gets
// its samples of a round in one job.

namespace carlo {

/// What a state has that `base`, from which it went on, has not; empty pixels elsewhere.
AdaptiveState round_part(const AdaptiveState& state, const AdaptiveState& base);

/// Puts a round's part into the state that it went on from. Throws Error if it went on from
/// another.
void add_round_part(AdaptiveState& base, const AdaptiveState& part);

/// Whether no pixel wants another sample, or none may have one: `spp` is the limit.
bool all_rounds_done(const AdaptiveState& state, std::uint32_t spp);

}  // namespace carlo
