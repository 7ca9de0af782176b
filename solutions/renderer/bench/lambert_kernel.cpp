// The vector kernel with one combination only: diffuse surfaces, no spheres. It takes the place of
// lane_kernel.cpp in carlo_bench_lambert.

#include "cli/error.h"
#include "renderer/lanes/lane_kernel.h"

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/bench/lambert_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// After the two above, which compile it anew.
#include "renderer/lanes/tile-inl.h"

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

HWY_ATTR void render_lambert(const LaneJob& job, std::span<std::array<double, 3>> means,
                             carlo::Counts& counts) {
  run<Features<false, false>>(job, means, counts);
}

std::string instruction_set() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace renderer {

/// Nobody asks this program for them.
void trace_lamps(const LampJob&, carlo::Splats&, carlo::Counts&) {
  throw carlo::Error("this kernel traces no paths from lamps");
}

HWY_EXPORT(render_lambert);
HWY_EXPORT(instruction_set);

void render_lanes(const LaneJob& job, std::span<std::array<double, 3>> means,
                  carlo::Counts& counts) {
  HWY_DYNAMIC_DISPATCH(render_lambert)(job, means, counts);
}

std::string lane_instruction_set() {
  return HWY_DYNAMIC_DISPATCH(instruction_set)();
}

}  // namespace renderer
#endif
