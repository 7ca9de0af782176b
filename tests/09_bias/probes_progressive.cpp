// Probes of exercise 9.6: they call the student's functions and return raw values;
// checks_progressive.cpp says what the values should be.

#include "09_bias/progressive_data.h"
#include "bias.h"
#include "grader/worker/probe.h"

namespace lab09_progressive {

using carlo::grader::RowWriter;

PROBE("Lab 9.6 next radius", "radius") {
  RowWriter rows;
  for (const auto& [radius, pass, alpha] : drawn_passes(params.seed))
    rows.add({lab09::next_radius(radius, pass, alpha)});
  return rows.take();
}

// The radius of pass n + 1, from pass to pass.
PROBE("Lab 9.6 many passes", "radius") {
  const ProgressiveRun run = drawn_run(params.seed);
  double radius = run.first_radius;
  for (std::int64_t pass = 1; pass <= params.n; ++pass)
    radius = lab09::next_radius(radius, static_cast<int>(pass), run.alpha);
  return {1, {radius}};
}

// The calls of progressive_mean(), and its result.
PROBE(
    "Lab 9.6 mean", "pass", "radius",
    "(a row for each pass that is asked for, n and no more; then how many those were, and 0; then "
    "red and green of the mean; then blue, and 0)") {
  const ProgressiveRun run = drawn_run(params.seed);
  carlo::Rng rng(params.seed);
  RowWriter rows;
  std::int64_t asked = 0;
  const carlo::Rgb mean = lab09::progressive_mean(
      static_cast<int>(params.n), run.first_radius, run.alpha, [&](int pass, double radius) {
        if (asked < params.n) rows.add({static_cast<double>(pass), radius});
        ++asked;
        return pass_radiance(static_cast<int>(asked), rng);
      });
  for (std::int64_t i = asked; i < params.n; ++i)
    rows.add({0, 0});
  rows.add({static_cast<double>(asked), 0});
  rows.add({static_cast<double>(mean.r), static_cast<double>(mean.g)});
  rows.add({static_cast<double>(mean.b), 0});
  return rows.take();
}

}  // namespace lab09_progressive
