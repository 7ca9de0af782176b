#include "renderer/production/adaptive_decisions.h"

#include "numeric/compensated.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace carlo {
namespace {

/// 95 % of normal errors are within this many standard errors.
constexpr double confidence = 1.96;
/// The worst pixel's error may be this many times the allowed root mean square error of its unit.
constexpr double worst_excess = 3;
constexpr double floor_fraction = 0.01;

/// Calls visit(pixel) for each pixel of a unit.
template <class Visit>
void for_each_pixel(const AdaptiveState& state, std::size_t unit, Visit visit) {
  const int x0 = static_cast<int>(unit) % state.columns * adaptive_unit_size;
  const int y0 = static_cast<int>(unit) / state.columns * adaptive_unit_size;
  for (int y = y0; y < std::min(y0 + adaptive_unit_size, state.height); ++y) {
    for (int x = x0; x < std::min(x0 + adaptive_unit_size, state.width); ++x)
      visit(state.pixel(x, y));
  }
}

/// The squared relative errors of the image if both halves were like this one.
struct SquaredErrors {
  double mean = 0, worst = 0;
};

SquaredErrors errors(const AdaptiveState& state, std::size_t unit, std::size_t half) {
  int pixels = 0;
  for_each_pixel(state, unit, [&](std::size_t) { ++pixels; });
  SquaredErrors result;
  for_each_pixel(state, unit, [&](std::size_t pixel) {
    const GroupedMean& seen = state.halves[half][pixel].seen();
    const double reference = std::fmax(seen.mean(), state.floors[half]);
    const double variance = seen.variance() / 2;
    const double squared = variance > 0 ? variance / (reference * reference) : 0;
    result.mean += squared / pixels;
    result.worst = std::fmax(result.worst, squared);
  });
  return result;
}

/// The mean noise of a unit and its eight neighbours, from one half's samples.
double noise_around(const AdaptiveState& state, std::size_t unit, std::size_t half) {
  const int column = static_cast<int>(unit) % state.columns,
            row = static_cast<int>(unit) / state.columns;
  const int rows = static_cast<int>(state.units.size()) / state.columns;
  double sum = 0, count = 0;
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, rows - 1); ++y) {
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, state.columns - 1); ++x) {
      sum += state.units[state.unit_number(x * adaptive_unit_size, y * adaptive_unit_size)]
                 .noise[half];
      ++count;
    }
  }
  return sum / count;
}

/// Estimates how many more samples a unit needs, for the progress bar.
double still_missing(double n, double most, double excess) {
  return adaptive_unit_size * adaptive_unit_size *
         (std::clamp(n * excess, 1.5 * n, std::fmax(most, 1.5 * n)) - n);
}

}  // namespace

double adaptive_floor(const AdaptiveState& state, std::size_t begin, std::size_t end) {
  CompensatedSum sum;
  for (std::size_t h = begin; h < end; ++h) {
    for (const HalfPixel& p : state.halves[h])
      sum.add(p.estimate(3).mean());
  }
  return floor_fraction *
         (sum.value() / static_cast<double>((end - begin) * state.halves[0].size()));
}

void set_floors(AdaptiveState& state) {
  for (std::size_t h = 0; h < 2; ++h)
    state.floors[h] = adaptive_floor(state, h, h + 1);
}

double decide_round(AdaptiveState& state, double target, const Levels& levels) {
  const double allowed = target * target / (confidence * confidence);
  const double n = levels.end(state.level), most = levels.end(levels.count() - 1);
  std::vector<std::array<SquaredErrors, 2>> found(state.units.size());
  for (std::size_t unit = 0; unit < state.units.size(); ++unit) {
    for (std::size_t half = 0; half < 2; ++half) {
      if (state.units[unit].fell[half]) continue;
      found[unit][half] = errors(state, unit, half);
      state.units[unit].noise[half] = n * found[unit][half].mean;
    }
  }
  double missing = 0;
  for (std::size_t unit = 0; unit < state.units.size(); ++unit) {
    for (std::size_t half = 0; half < 2; ++half) {
      if (state.units[unit].fell[half]) continue;
      const SquaredErrors& e = found[unit][half];
      const double mean = std::fmax(e.mean, noise_around(state, unit, half) / n);
      if (mean <= allowed && e.worst <= worst_excess * worst_excess * allowed) {
        state.units[unit].fell[half] = true;
        for_each_pixel(state, unit,
                       [&](std::size_t pixel) { state.halves[1 - half][pixel].finish(); });
      } else {
        missing += still_missing(n, most, mean / allowed);
      }
    }
  }
  return missing;
}

}  // namespace carlo
