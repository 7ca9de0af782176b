#pragma once

#include "course/render/report.h"
#include "renderer/production/adaptive.h"

#include <cstdint>

// Additions to the reports of renders with a target error and of merged ones.

namespace carlo {

void add_target(RenderReport& report, const AdaptiveSummary& summary);

/// `share`: the fraction of all samples that is present.
void add_parts(RenderReport& report, std::uint64_t parts, double share);

}  // namespace carlo
