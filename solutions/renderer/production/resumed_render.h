#pragma once

#include "render/driver.h"
#include "renderer/production/adaptive_state.h"
#include "renderer/production/arguments.h"
#include "renderer/production/resume.h"

#include <cstdint>
#include <optional>

// Continuing an earlier render: `render --resume`.

namespace carlo {

/// Takes options that the command line leaves open from the earlier render. Throws Error for
/// options with which it cannot be continued.
void fill_from(ProductionArguments& a, const EarlierRender& earlier);

/// Returns the state to continue from, up to `spp` samples per pixel if given. Throws Error if the
/// render cannot be continued to that number.
RenderResult uniform_start(const EarlierRender& earlier, std::optional<std::uint32_t> spp);

/// The same for a render with a target error.
EarlierAdaptive adaptive_start(const EarlierRender& earlier);

}  // namespace carlo
