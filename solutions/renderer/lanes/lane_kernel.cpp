#include "renderer/lanes/lane_kernel.h"

#include "support/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/lanes/lane_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Highway insists on compiling for the oldest set, which has no FMA; nothing renders with it.
#undef CARLO_EMPTY_SET
#if !HWY_NATIVE_FMA
#define CARLO_EMPTY_SET
#else
// These follow the two headers above, which compile them anew.
#include "renderer/lanes/light_paths-inl.h"
#include "renderer/lanes/sharing-inl.h"
#include "renderer/lanes/straight-inl.h"
#include "renderer/lanes/tile-inl.h"
#endif

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

#if defined(CARLO_EMPTY_SET)
// Never called: lane_instruction_sets() does not name it, so nothing renders by it.
void render_tile(const LaneJob&, std::span<std::array<double, 3>>, carlo::Counts&) {
  std::abort();
}

void run_light_job(const LightPathJob&, carlo::Splats&, carlo::Counts&) {
  std::abort();
}
#else

/// Calls f with the cheapest Features that the job can be rendered with.
template <class F>
HWY_ATTR void with_needs(const LaneJob& job, const F& f) {
  const LaneScene& s = job.scene;
  const bool light_paths = job.choices.light_paths > 0, close = s.close(), lean = !s.full();
  if (light_paths) {
    if (!lean)
      f(Features<true, true, true, true>());
    else
      s.phong ? f(Features<true, true, false, true>()) : f(Features<false, true, false, true>());
  } else if (!lean) {
    f(Features<true, true, true>());
  } else if (s.phong) {
    close ? f(Features<true, true>()) : f(Features<true, false>());
  } else {
    close ? f(Features<false, true>()) : f(Features<false, false>());
  }
}

template <bool close, bool full>
HWY_ATTR void run_shared(const LaneJob& job, std::span<std::array<double, 3>> means,
                         carlo::Counts& counts) {
  using Needs = Features<full, close, full, false, false, true>;
  std::make_unique<SharedPaths<Needs>>(job, means, counts)->run();
}

HWY_ATTR void render_tile(const LaneJob& job, std::span<std::array<double, 3>> means,
                          carlo::Counts& counts) {
  if (job.max_depth == 1 && job.scene.straight()) return StraightPaths(job, means, counts).run();
  if (!job.shares()) {
    with_needs(job, [&]<class Needs>(Needs) HWY_ATTR { run<Needs>(job, means, counts); });
  } else if (job.scene.full()) {
    run_shared<true, true>(job, means, counts);
  } else if (job.scene.close()) {
    run_shared<true, false>(job, means, counts);
  } else {
    run_shared<false, false>(job, means, counts);
  }
  if (!job.lights_apart.empty()) SeenLights(job, means, counts).run();
}

HWY_ATTR void run_light_job(const LightPathJob& job, carlo::Splats& splats, carlo::Counts& counts) {
  with_needs(job.whole, [&]<class Needs>(Needs) HWY_ATTR {
    if constexpr (Needs::light_paths) run_light_paths<Needs>(job, splats, counts);
  });
}
#endif

std::string instruction_set() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace renderer {

HWY_EXPORT(render_tile);
HWY_EXPORT(run_light_job);
HWY_EXPORT(instruction_set);

void render_lanes(const LaneJob& job, std::span<std::array<double, 3>> means,
                  carlo::Counts& counts) {
  HWY_DYNAMIC_DISPATCH(render_tile)(job, means, counts);
}

void trace_light_paths(const LightPathJob& job, carlo::Splats& splats, carlo::Counts& counts) {
  HWY_DYNAMIC_DISPATCH(run_light_job)(job, splats, counts);
}

std::string lane_instruction_set() {
  return HWY_DYNAMIC_DISPATCH(instruction_set)();
}

std::vector<std::string> lane_instruction_sets() {
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
#if defined(CARLO_EMPTY_SET)
    if (target == HWY_STATIC_TARGET) continue;
#endif
    names.emplace_back(hwy::TargetName(target));
  }
  return names;
}

bool lanes_suit_machine() {
#if defined(CARLO_WIDEST_SET_ALONE)
  return true;
#else
  return !lane_instruction_sets().empty();
#endif
}

void use_instruction_set(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);
  const std::vector<std::string> names = lane_instruction_sets();
  if (!name.empty()) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      throw carlo::Error("this machine has no instruction set '{}'; it has {}", name,
                         fmt::join(names, ", "));
    }
    const auto i = static_cast<std::size_t>(found - names.begin());
    hwy::SetSupportedTargetsForTest(hwy::SupportedAndGeneratedTargets()[i]);
  }
  hwy::GetChosenTarget().DeInit();
}

}  // namespace renderer
#endif
