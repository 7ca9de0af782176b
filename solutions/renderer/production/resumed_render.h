#pragma once

#include "render/driver.h"
#include "renderer/production/adaptive_state.h"
#include "renderer/production/arguments.h"
#include "renderer/production/state_file.h"

#include <cstdint>
#include <optional>

// Continuing an earlier render: `render --resume`.

namespace carlo {

/// Takes the settings that the command line leaves open from the earlier render. Throws Error for
/// options that do not allow to continue it.
void take_over(ProductionArguments& a, const StateFile& earlier);

/// Throws Error if a render with these settings would have other bits.
void require_same(const StateFile& earlier, const RenderSettings& settings);

/// Returns the result to continue from, up to `spp` samples per pixel if given. Throws Error if
/// that is impossible.
RenderResult uniform_start(const StateFile& earlier, std::optional<std::uint32_t> spp);

/// The same with a target error.
EarlierAdaptive adaptive_start(const StateFile& earlier);

}  // namespace carlo
