// Lab 6: two densities and their MIS weights, Veach's plates, and a tail that error bars miss.

#include "call.h"
#include "importance.h"
#include "power_family.h"

#include <array>
#include <cmath>

namespace site {
namespace {

using namespace lab06;

/// One light and one lobe on the line: the light is centred at 1/2, the mirror direction is m.
struct Setting {
  double half, scale, m;

  Density light() const { return uniform_density(0.5 - half, 0.5 + half); }
  Density lobe() const { return logistic_density(m, scale); }
  /// Radiance 1/(2 half) times the lobe.
  lab06::Function f() const {
    return [light = light(), lobe = lobe()](double x) { return light.pdf(x) * lobe.pdf(x); };
  }
  double exact() const {
    const auto cdf = [this](double x) { return 1 / (1 + std::exp(-(x - m) / scale)); };
    // On the lobe's side where both values are small, so that no digits are lost.
    const double from = 0.5 - half, to = 0.5 + half;
    const double part = from > m ? cdf(2 * m - from) - cdf(2 * m - to) : cdf(to) - cdf(from);
    return part / (2 * half);
  }
};

/// half, scale, m, points, from, to: f, the two densities, and the light's weights by the balance
/// and by the power heuristic, at points of [from, to].
Numbers curves(const Arguments& given) {
  const Setting setting{given[0], given[1], given[2]};
  const Density light = setting.light(), lobe = setting.lobe();
  const lab06::Function f = setting.f();
  Numbers results;
  for (std::int64_t i = 0; i < given.whole(3); ++i) {
    const double x = given[4] + (static_cast<double>(i) + 0.5) / given[3] * (given[5] - given[4]);
    const Effort own{1, light.pdf(x)}, other{1, lobe.pdf(x)};
    results.insert(results.end(), {x, f(x), own.pdf, other.pdf, balance_weight(own, other),
                                   power_weight(own, other)});
  }
  return results;
}

/// half, scale, m, way (0 light, 1 lobe, 2 both with balance, 3 with power weights), N, runs, seed:
/// the RMS error relative to the integral; the mean of the runs; the integral.
Numbers errors(const Arguments& given) {
  const Setting setting{given[0], given[1], given[2]};
  const std::int64_t n = given.whole(4), way = given.whole(3);
  const Heuristic heuristic = way == 2 ? balance_weight : power_weight;
  const std::int64_t of_light = way == 0 ? n : way == 1 ? 0 : n / 2;
  const Technique light{setting.light(), of_light}, lobe{setting.lobe(), n - of_light};
  const lab06::Function f = setting.f();
  carlo::Rng rng = given.rng(6, 4);
  double sum = 0;
  const auto trial = [&] {
    const double value = multi_sample(f, light, lobe, heuristic, rng);
    sum += value;
    return value;
  };
  const double exact = setting.exact(), error = rms_error(given.whole(5), exact, trial);
  return {error / exact, sum / given[5], exact};
}

/// Veach's plates on the line: lights of equal power, from a point to a panel, as settings of one
/// mirror direction and one lobe.
std::vector<Setting> plate_lights(double size, double scale, double m) {
  constexpr std::array<std::array<double, 2>, 4> lights = {
      {{0.125, 0.0008}, {0.375, 0.005}, {0.625, 0.025}, {0.86, 0.09}}};
  std::vector<Setting> settings;
  // A setting has its light at 1/2: the mirror direction moves instead.
  for (const auto& [centre, half] : lights)
    settings.push_back({half * size, scale, m + 0.5 - centre});
  return settings;
}

/// way (0 lights, 1 lobe, 2 both with power weights, 3 exact), samples, seed, plate, columns, rows,
/// factors of the lights' sizes and of the lobes' scales: estimates of a plate's pixels, row by
/// row. A sample chooses one of the lights; directions of the lobe see all.
Numbers plate(const Arguments& given) {
  constexpr std::array<double, 4> scales = {0.0006, 0.003, 0.012, 0.05};
  const double scale = scales.at(given.index(3)) * given[7];
  const std::int64_t way = given.whole(0), n = given.whole(1);
  const std::int64_t of_lights = way == 0 ? n : way == 1 ? 0 : n / 2;
  carlo::Rng rng = given.rng(2, 3);
  Numbers pixels;
  for (std::int64_t i = 0; i < given.whole(4) * given.whole(5); ++i) {
    const double m = (static_cast<double>(i % given.whole(4)) + 0.5) / given[4];
    const std::vector<Setting> lights = plate_lights(given[6], scale, m);
    if (way == 3) {
      double sum = 0;
      for (const Setting& light : lights)
        sum += light.exact();
      pixels.push_back(sum);
      continue;
    }
    // In coordinates of the offset from m, where all lights share one lobe.
    const auto radiance = [&](double offset) {
      double sum = 0;
      for (const Setting& light : lights)
        sum += light.light().pdf(offset + light.m);
      return sum;
    };
    const Density lobe = logistic_density(0, scale);
    const Density points = {[&](double u) {
                              const auto chosen = static_cast<std::size_t>(4 * u);
                              const Setting& light = lights[chosen];
                              return light.light().sample(4 * u - static_cast<double>(chosen)) -
                                     light.m;
                            },
                            [&](double offset) { return radiance(offset) / 4; }};
    pixels.push_back(multi_sample([&](double x) { return radiance(x) * lobe.pdf(x); },
                                  {points, of_lights}, {lobe, n - of_lights}, power_weight, rng));
  }
  return pixels;
}

/// exponent n of p, N, runs, seed: the RMS error of the integral of 5 x^4 over [0, 1], the share of
/// 95 % intervals that hold it, the largest share of a contribution in the last run, the variance
/// of one contribution and the tail index, both in closed form.
Numbers tails(const Arguments& given) {
  const Density p = power_density(given[0]);
  carlo::Rng rng = given.rng(3, 1);
  double held = 0, share = 0;
  const auto trial = [&] {
    const std::vector<double> values = contributions(power_f, p, given.whole(1), rng);
    const Estimate e = summarize(values);
    share = largest_share(values);
    held += std::abs(e.value - power_integral) <= 1.96 * e.standard_error ? 1 : 0;
    return e.value;
  };
  const double error = rms_error(given.whole(2), power_integral, trial);
  return {error, held / given[2], share, power_variance(given[0]), power_tail_index(given[0])};
}

const Function functions[] = {
    {"6.curves", curves}, {"6.errors", errors}, {"6.plate", plate}, {"6.tails", tails}};

}  // namespace
}  // namespace site
