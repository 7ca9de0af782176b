#include "grader/judge/draws.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace carlo::grader {
namespace {

/// Returns the distances from the nearer end of [0, 1], sorted: the same for u and for 1 - u.
std::vector<double> folded(std::vector<double> shares) {
  for (double& share : shares)
    share = std::min(share, 1 - share);
  std::sort(shares.begin(), shares.end());
  return shares;
}

}  // namespace

Verdict draws(double words, double expected) {
  const Diagnosis floats{"uniform-float-drawn",
                         "the numbers are floats, with 24 random bits: take rng.uniform()."};
  const Diagnosis surplus{"surplus-numbers-drawn",
                          "more random numbers are drawn than its points have coordinates: each "
                          "one costs time, and what draws next gets other numbers."};
  std::string measured = fmt::format("{:g}", words / 2);
  std::vector<Diagnosis> diagnosis;
  if (words < 0)
    measured = "unknown: rng was reset or replaced, or far too many numbers were drawn";
  if (words == expected) {
    measured = fmt::format("{:g} of rng.uniform_float()", words);
    diagnosis = {floats};
  } else if (words > 2 * expected) {
    diagnosis = {surplus};
  }
  return holds("the numbers drawn (calls of rng.uniform())", words == 2 * expected, measured,
               fmt::format("{:g}", expected), diagnosis);
}

Verdict draws(const Rng& before, const NextWords& next, double expected) {
  return draws(words_drawn(before, next, 4 * static_cast<std::int64_t>(expected) + 64), expected);
}

Verdict made_of(const std::string& what, std::vector<double> shares, Rng before) {
  // Shares recovered from points carry the points' rounding; floats are 3e-8 off.
  constexpr double rounding = 1e-9;
  std::vector<double> drawn(shares.size());
  for (double& number : drawn)
    number = before.uniform();
  // NaN cannot be sorted.
  bool same = std::all_of(shares.begin(), shares.end(), [](double x) { return std::isfinite(x); });
  if (same) {
    shares = folded(std::move(shares));
    drawn = folded(std::move(drawn));
    for (std::size_t i = 0; i < shares.size(); ++i)
      same = same && std::abs(shares[i] - drawn[i]) <= rounding;
  }
  return is_so(what, same, "somewhere else", "where the numbers of rng.uniform() put them");
}

}  // namespace carlo::grader
