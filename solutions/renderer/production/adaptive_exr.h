#pragma once

#include "image/exr.h"
#include "renderer/production/adaptive_state.h"

#include <string>
#include <vector>

namespace carlo {

/// Returns the channels that hold an adaptive render's state bit by bit: two for each double.
std::vector<std::string> adaptive_channels();

/// Adds these channels, and everything that does not belong to a pixel as attributes.
void add_adaptive_state(ExrFile& file, const AdaptiveState& state);

/// Reads back what add_adaptive_state() added. Throws Error if anything is missing or not a number.
AdaptiveState adaptive_state_of(const ExrFile& file);

}  // namespace carlo
