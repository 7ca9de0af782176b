#include "render/adaptive_rounds.h"

#include "cli/error.h"
#include "render/adaptive_levels.h"

#include <algorithm>
#include <cstddef>

namespace carlo {

AdaptiveState round_part(const AdaptiveState& state, const AdaptiveState& base) {
  AdaptiveState part(state.width, state.height);
  part.level = state.level;
  for (std::size_t half = 0; half < 2; ++half) {
    for (std::size_t i = 0; i < state.halves[half].size(); ++i) {
      const HalfPixel& pixel = state.halves[half][i];
      if (pixel.seen().samples() > base.halves[half][i].seen().samples())
        part.halves[half][i] = pixel;
    }
  }
  return part;
}

void add_round_part(AdaptiveState& base, const AdaptiveState& part) {
  if (part.width != base.width || part.height != base.height || part.level != base.level) {
    throw Error("it is of round {} of {} x {} pixels, and not {} of {} x {}", part.level,
                part.width, part.height, base.level, base.width, base.height);
  }
  for (std::size_t half = 0; half < 2; ++half) {
    for (std::size_t i = 0; i < part.halves[half].size(); ++i) {
      const double samples = part.halves[half][i].seen().samples();
      if (!(samples > 0)) continue;
      if (!(samples > base.halves[half][i].seen().samples()))
        throw Error("it has samples that are there already");
      base.halves[half][i] = part.halves[half][i];
    }
  }
}

bool all_rounds_done(const AdaptiveState& state, std::uint32_t spp) {
  return state.level >= Levels(spp).count() ||
         std::none_of(state.units.begin(), state.units.end(),
                      [](const AdaptiveState::Unit& unit) { return unit.active(); });
}

}  // namespace carlo
