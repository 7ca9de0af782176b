#include "renderer/production/adaptive_state.h"

#include <cmath>

namespace carlo {

AdaptiveState::AdaptiveState(int film_width, int film_height)
    : width(film_width),
      height(film_height),
      columns((film_width + adaptive_unit_size - 1) / adaptive_unit_size),
      units(static_cast<std::size_t>(columns) *
            static_cast<std::size_t>((film_height + adaptive_unit_size - 1) / adaptive_unit_size)) {
  for (auto& half : halves)
    half.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

double AdaptiveState::undecided(std::size_t half) const {
  const auto count = std::count_if(units.begin(), units.end(),
                                   [half](const Unit& unit) { return !unit.fell[half]; });
  return std::fmax(1, static_cast<double>(count)) / static_cast<double>(units.size());
}

AdaptiveEstimate adaptive_estimate(const HalfPixel& a, const HalfPixel& b, std::size_t channel) {
  const GroupedMean& p = a.estimate(channel);
  const GroupedMean& q = b.estimate(channel);
  if (!(q.samples() > 0)) return {p.mean(), p.variance()};
  if (!(p.samples() > 0)) return {q.mean(), q.variance()};
  return {(p.mean() + q.mean()) / 2, (p.variance() + q.variance()) / 4};
}

double expected_within(const AdaptiveState& state, double target, double floor) {
  double sum = 0;
  for (std::size_t i = 0; i < state.halves[0].size(); ++i) {
    const AdaptiveEstimate e = adaptive_estimate(state.halves[0][i], state.halves[1][i], 3);
    const double allowed = target * std::fmax(e.mean, floor);
    sum += e.variance > 0 ? std::erf(allowed / std::sqrt(2 * e.variance)) : 1;
  }
  return sum / static_cast<double>(state.halves[0].size());
}

Film AdaptiveState::film() const {
  Film film(width, height, 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const HalfPixel& a = halves[0][pixel(x, y)];
      const HalfPixel& b = halves[1][pixel(x, y)];
      std::array<double, 3> mean, error;
      for (std::size_t c = 0; c < 3; ++c) {
        const AdaptiveEstimate e = adaptive_estimate(a, b, c);
        mean[c] = e.mean;
        error[c] = std::sqrt(e.variance);
      }
      const double samples = a.estimate(0).samples() + b.estimate(0).samples();
      if (samples > 0) film.set_estimate(x, y, mean, error, static_cast<std::uint64_t>(samples));
    }
  }
  return film;
}

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
