#pragma once

#include "08_path_tracer/theory.h"
#include "08_path_tracer/views.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

// The worlds with closed forms for the paths of exercises 8.4 to 8.8, their expected results, and
// the mistakes that several of these exercises share.

namespace lab08_tests {

inline const carlo::grader::Diagnosis one_bounce{"emission-of-first-surface-only",
                                                 "only the first surface's emission counts."};
inline const carlo::grader::Diagnosis self_hit{
    "ray-meets-its-own-surface",
    "light is lost: a ray that starts on a surface hits it again; world.leave() offsets its origin."};
inline const carlo::grader::Diagnosis sky_missing{
    "environment-missing", "the radiance of rays that meet no surface is world.environment()."};
inline const carlo::grader::Diagnosis absorbed_dark{
    "absorbed-path-loses-light",
    "a path that sample() absorbs contributes nothing at all: the radiance gathered until then, "
    "and the emission of the surface where it ends, still count."};

constexpr std::size_t paths = 50'000;

enum Method { lecture = 0, mended = 1, direct = 2 };

inline carlo::grader::Params with(Place place, std::map<std::string, double> numbers) {
  numbers.insert({{"place", static_cast<double>(place)}, {"degrees", 0}, {"emission", 1}});
  return {.n = paths, .numbers = std::move(numbers)};
}

inline carlo::grader::Rows trace(Method method, carlo::grader::Params params) {
  params.numbers["method"] = static_cast<double>(method);
  const char* const rules[] = {"the lecture's rule, ", "mended, ", ""};
  return carlo::grader::probe(
      "Lab 8 paths", params,
      {.rows = paths, .columns = 3, .of = fmt::format("{}{}", rules[method], view_text(params))});
}

inline carlo::grader::Params furnace_of(double r, double g) {
  return with(in_furnace, {{"r", r}, {"g", g}, {"b", r}});
}

inline constexpr PhongCase glossy{0.3f, 0.6f, 50};
constexpr double slant = 60;

inline carlo::grader::Params ball_of(const PhongCase& c) {
  return with(on_ball, {{"kd", static_cast<double>(c.kd)},
                        {"ks", static_cast<double>(c.ks)},
                        {"exponent", static_cast<double>(c.n)},
                        {"degrees", slant}});
}

/// Radiance of the glossy ball under a sky of 1.
inline carlo::grader::Theory ball_theory() {
  const Moments m = PhongTheory(glossy).weights(slant);
  return {
      static_cast<double>(glossy.kd) + static_cast<double>(glossy.ks) * specular_albedo(50, slant),
      m.sd()};
}

/// For emission 1 at every vertex of a path that continues with probability `go` and weight
/// `weight`: mean and sd of 1 + weight + weight^2 + ...
inline carlo::grader::Theory series(double go, double weight) {
  const double mean = 1 / (1 - go * weight);
  const double square = (1 + 2 * go * weight * mean) / (1 - go * weight * weight);
  return {mean, std::sqrt(square - mean * mean)};
}

inline const double light_path_share =
    0.7522747 / pi;  ///< of cosine-weighted directions that meet the square light

/// True if absorbed paths contribute nothing: in a furnace every surface emits, and every path that
/// counts it contributes.
inline bool ends_dark(const std::vector<double>& in_furnace) {
  return std::find(in_furnace.begin(), in_furnace.end(), 0) != in_furnace.end();
}

}  // namespace lab08_tests
