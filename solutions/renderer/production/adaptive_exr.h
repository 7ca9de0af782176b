#pragma once

#include "image/exr.h"
#include "renderer/production/adaptive_state.h"

#include <string>
#include <vector>

namespace carlo {

/// The channels that hold an adaptive render's state, bit by bit: a double is two of them.
std::vector<std::string> adaptive_channels();

/// Adds those channels, and what does not belong to a pixel as attributes.
void add_adaptive_state(ExrFile& file, const AdaptiveState& state);

/// What add_adaptive_state() added. Throws Error if anything is missing or no number.
AdaptiveState adaptive_state_of(const ExrFile& file);

}  // namespace carlo
