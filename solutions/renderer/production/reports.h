#pragma once

#include "course/render/report.h"
#include "renderer/production/adaptive.h"

#include <cstdint>

// What a report tells besides of renders that stop by themselves, and of merged ones.

namespace carlo {

void tell_target(RenderReport& report, const AdaptiveSummary& summary);

/// `share`: of all samples, how much is there.
void tell_parts(RenderReport& report, std::uint64_t parts, double share);

}  // namespace carlo
