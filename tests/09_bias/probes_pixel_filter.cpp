// Probes of exercise 9.2: they call the student's functions and return raw values;
// checks_pixel_filter.cpp and checks_pixel_rays.cpp say what the values should be.

#include "09_bias/pixel_filter_data.h"
#include "bias.h"
#include "grader/worker/probe.h"

namespace lab09_pixels {

using carlo::grader::Params;
using carlo::grader::RowWriter;

namespace {

lab09::PixelFilter filter_of(const FilterCase& c) {
  return {static_cast<lab09::PixelFilter::Curve>(c.curve), c.radius, c.sigma};
}

lab09::PixelFilter filter_of(const Params& params) {
  return filter_of(drawn_filters(params.seed).at(static_cast<std::size_t>(params.whole("filter"))));
}

carlo::Rgb pixel_of(const Params& params, const carlo::Camera& camera, int samples,
                    const lab09::Radiance& radiance, carlo::Rng& rng) {
  const int x = static_cast<int>(params.whole("x")), y = static_cast<int>(params.whole("y"));
  return (params.whole("weighted") == 0 ? lab09::filtered_pixel : lab09::weighted_pixel)(
      camera, film_width, film_height, x, y, filter_of(params), samples, radiance, rng);
}

/// Where a ray goes through the film, in pixels from the middle of pixel (x, y).
PixelPoint offset_of(const carlo::Ray& ray, const Params& params) {
  const double across = static_cast<double>(ray.d.x) / -static_cast<double>(ray.d.z);
  const double up = static_cast<double>(ray.d.y) / -static_cast<double>(ray.d.z);
  return {(across + 1) * film_width / 2 - params["x"] - 0.5,
          (1 - up) * film_height / 2 - params["y"] - 0.5};
}

}  // namespace

PROBE("Lab 9.2 values", "value") {
  const lab09::PixelFilter filter = filter_of(params);
  RowWriter rows;
  for (const PixelPoint p : drawn_points(params.seed))
    rows.add({lab09::filter_value(filter, p.x * filter.radius, p.y * filter.radius)});
  return rows.take();
}

// At the middles of n x n squares that cover one and a half radii to each side.
PROBE("Lab 9.2 grid", "value") {
  const lab09::PixelFilter filter = filter_of(params);
  const auto place = [&](std::int64_t i) {
    const double side = static_cast<double>(params.n);
    return 1.5 * filter.radius * ((2 * static_cast<double>(i) + 1) / side - 1);
  };
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    for (std::int64_t j = 0; j < params.n; ++j)
      rows.add({lab09::filter_value(filter, place(i), place(j))});
  }
  return rows.take();
}

PROBE("Lab 9.2 offsets", "x", "y") {
  const lab09::PixelFilter filter = filter_of(params);
  RowWriter rows;
  for (const PixelPoint u : drawn_pairs(params.seed)) {
    const lab09::Offset offset =
        lab09::sample_filter(filter, {static_cast<float>(u.x), static_cast<float>(u.y)});
    rows.add({offset.x, offset.y});
  }
  return rows.take();
}

// The positions of one pixel's rays, in pixels from its middle, with the filter's values there (for
// weighted pixels); and the result from their radiances.
PROBE(
    "Lab 9.2 rays", "x", "y", "value",
    "(a row for each ray, n and no more; then red, green and blue of the pixel; then how many rays "
    "there were, 0 and 0)") {
  const std::vector<RayRadiance> radiances = drawn_radiance(params.seed, params.n);
  const lab09::PixelFilter filter = filter_of(params);
  const bool weighted = params.whole("weighted") != 0;
  carlo::Rng rng(params.seed);
  RowWriter rows;
  std::int64_t rays = 0;
  const carlo::Rgb pixel = pixel_of(
      params, carlo::Camera(), static_cast<int>(params.n),
      [&](const carlo::Ray& ray) {
        if (rays++ >= params.n) return carlo::Rgb(0);
        const PixelPoint p = offset_of(ray, params);
        rows.add({p.x, p.y, weighted ? lab09::filter_value(filter, p.x, p.y) : 0});
        const RayRadiance& b = radiances[static_cast<std::size_t>(rays - 1)];
        return carlo::Rgb(b.r, b.g, b.b);
      },
      rng);
  for (std::int64_t i = rays; i < params.n; ++i)
    rows.add({0, 0, 0});
  rows.add(
      {static_cast<double>(pixel.r), static_cast<double>(pixel.g), static_cast<double>(pixel.b)});
  rows.add({static_cast<double>(rays), 0, 0});
  return rows.take();
}

// Estimates of a pixel with an edge through it: it is lit on the right.
PROBE("Lab 9.2 edges", "estimate") {
  const double edge = drawn_edge(params.seed) * filter_of(params).radius;
  carlo::Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const carlo::Rgb pixel = pixel_of(
        params, carlo::Camera(), static_cast<int>(params.whole("samples")),
        [&](const carlo::Ray& ray) {
          return carlo::Rgb(offset_of(ray, params).x > edge ? 1.0f : 0.0f);
        },
        rng);
    rows.add({static_cast<double>(pixel.g)});
  }
  return rows.take();
}

// No samples, so no weights.
PROBE("Lab 9.2 nothing", "red", "green", "blue") {
  carlo::Rng rng(params.seed);
  const carlo::Rgb pixel = pixel_of(
      params, carlo::Camera(), 0, [](const carlo::Ray&) { return carlo::Rgb(1); }, rng);
  return {
      3,
      {static_cast<double>(pixel.r), static_cast<double>(pixel.g), static_cast<double>(pixel.b)}};
}

}  // namespace lab09_pixels
