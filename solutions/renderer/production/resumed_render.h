#pragma once

#include "render/driver.h"
#include "renderer/production/adaptive_state.h"
#include "renderer/production/arguments.h"
#include "renderer/production/resume.h"

#include <cstdint>
#include <optional>

// Going on with an earlier render: `render --resume`.

namespace carlo {

/// What the command line leaves open is as in the earlier render. Throws Error for what a render
/// cannot go on by.
void take_over(ProductionArguments& a, const EarlierRender& earlier);

/// What to go on from, up to `spp` samples a pixel if they are given. Throws Error where these are
/// no way to go on.
RenderResult uniform_start(const EarlierRender& earlier, std::optional<std::uint32_t> spp);

/// The same with a target error.
EarlierAdaptive adaptive_start(const EarlierRender& earlier);

}  // namespace carlo
