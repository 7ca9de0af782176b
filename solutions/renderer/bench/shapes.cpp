#include "context.h"
#include "methods.h"
#include "random/rng.h"
#include "render/scene_film.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

// How the cost of a path grows with the number of shapes, and of small lights.

namespace bench {
namespace {

using carlo::Rgb;
using carlo::Rng;
using carlo::Scene;
using carlo::Shape;
using carlo::Vec3;

float between(Rng& rng, float low, float high) {
  return low + (high - low) * static_cast<float>(rng.uniform());
}
Vec3 in_cube(Rng& rng) {
  const float x = between(rng, -1, 1), y = between(rng, -1, 1);
  return {x, y, between(rng, -1, 1)};
}

Scene empty_scene(Vec3 eye, float tangent) {
  Scene scene;
  scene.materials = {{carlo::Diffuse{Rgb(0.5f)}, true}};
  scene.width = scene.height = 64;
  scene.sampler = carlo::SamplerKind::sobol;
  scene.camera.origin = eye;
  scene.camera.forward = glm::normalize(-eye);
  scene.camera.right = glm::normalize(glm::cross(scene.camera.forward, Vec3(0, 1, 0)));
  scene.camera.up = glm::cross(scene.camera.right, scene.camera.forward);
  scene.camera.tan_half_x = scene.camera.tan_half_y = tangent;
  return scene;
}

enum class Kind { rectangles, boxes, spheres };
constexpr std::array kinds = {Kind::rectangles, Kind::boxes, Kind::spheres};

std::string name_of(Kind kind) {
  return kind == Kind::rectangles ? "rectangles" : kind == Kind::boxes ? "boxes" : "spheres";
}

void add_rectangle(Scene& scene, Vec3 corner, Vec3 u, Vec3 v) {
  scene.shapes.push_back({carlo::Parallelogram{corner, u, v}, 0, Rgb(0)});
}

/// A cloud of `count` shapes in a white environment. The sum of their areas is the same for all
/// counts, so that rays meet as many.
Scene cloud(Kind kind, int count) {
  Scene scene = empty_scene({0, 0, 5}, 0.25f);
  scene.lights.environment = Rgb(1);
  Rng rng(1, static_cast<std::uint64_t>(count));
  const float size = 1.5f / std::sqrt(static_cast<float>(count));
  for (int i = 0; i < count; ++i) {
    const Vec3 p = in_cube(rng), u = size * glm::normalize(in_cube(rng));
    const Vec3 v = size * glm::normalize(glm::cross(u, in_cube(rng))), w = glm::cross(u, v) / size;
    if (kind == Kind::spheres) {
      scene.shapes.push_back({carlo::Sphere{p, size / 2}, 0, Rgb(0)});
    } else if (kind == Kind::rectangles) {
      add_rectangle(scene, p, u, v);
    } else {
      for (const auto& [a, b, c] :
           {std::array{u, v, w}, std::array{v, w, u}, std::array{w, u, v}}) {
        add_rectangle(scene, p, 0.5f * b, 0.5f * a);
        add_rectangle(scene, p + 0.5f * c, 0.5f * a, 0.5f * b);
      }
    }
  }
  return scene;
}

/// Small lights close above a floor, about 1 apart: each lights its neighbourhood.
Scene lit_floor(int count, bool points) {
  const auto side = static_cast<int>(std::ceil(std::sqrt(count)));
  const auto half = 0.5f * static_cast<float>(side);
  Scene scene = empty_scene({0, 2 * half + 1, 1.5f * half + 1}, 0.36f);
  scene.materials.push_back({carlo::Diffuse{Rgb(0)}, true});
  const float far = 2 * half + 2;
  add_rectangle(scene, {-far, 0, far}, {2 * far, 0, 0}, {0, 0, -2 * far});
  Rng rng(2, static_cast<std::uint64_t>(count));
  for (int i = 0; i < count; ++i) {
    const int rows_before = i / side;
    const auto column = static_cast<float>(i % side), row = static_cast<float>(rows_before);
    const Vec3 p(column - half + between(rng, 0.2f, 0.8f), between(rng, 0.2f, 0.5f),
                 row - half + between(rng, 0.2f, 0.8f));
    const float power = between(rng, 0.5f, 2);
    if (points) {
      scene.lights.points.push_back({p, Rgb(0.07f * power)});
    } else {
      const carlo::Parallelogram facing_down{p, {0.06f, 0, 0}, {0, 0, 0.06f}};
      scene.shapes.push_back({facing_down, 1, Rgb(20 * power)});
    }
  }
  return scene;
}

/// The cost and the error of the runs of one scene by one method.
struct Cost {
  Spread seconds;     ///< of a processor, a path
  double efficiency;  ///< of the image's mean: 1 / (relative variance x seconds)
};
Cost cost(const Context& context, const Scene& scene, Method method) {
  const std::uint32_t samples = context.options().full ? 64 : 16;
  std::vector<double> seconds;
  double efficiency = 0;
  const int runs = context.options().full ? 5 : 3;
  for (int run = 0; run < runs; ++run) {
    const std::uint64_t seed = context.options().seed + static_cast<std::uint64_t>(run);
    const auto integrator = make_integrator(method, scene, seed, samples);
    const Rendered rendered = render_timed(*integrator, scene, samples);
    seconds.push_back(rendered.seconds / rendered.paths);
    const carlo::MeanRadiance mean = carlo::mean_radiance(rendered.film);
    const double relative = mean.standard_error[1] / mean.value[1];
    efficiency += 1 / (relative * relative * rendered.seconds) / runs;
  }
  return {spread(seconds), efficiency};
}

std::vector<int> counts(const Context& context) {
  std::vector<int> sizes = {10, 100, 1000, 10'000};
  if (context.options().full) sizes.push_back(100'000);
  return sizes;
}

const carlo::Axis of_shapes{"number", carlo::Unit::count};
const carlo::Axis of_seconds{"processor seconds a path", carlo::Unit::seconds};

void bench_clouds(Context& context) {
  carlo::Table table(
      {"shapes", "number", "processor time a path [range]", "scalar, by Embree [range]"},
      {"shapes", "number", "seconds_a_path", "scalar_seconds_a_path"});
  std::vector<carlo::Series> best, scalar;
  double done = 0;
  for (const Kind kind : kinds) {
    best.push_back({name_of(kind), {}}), scalar.push_back({name_of(kind), {}});
    for (const int count : counts(context)) {
      const Scene scene = cloud(kind, count);
      const Cost ours = cost(context, scene, Method::best),
                 embree = cost(context, scene, Method::scalar);
      table.add_row({name_of(kind), count, seconds_spread_cell(ours.seconds),
                     seconds_spread_cell(embree.seconds)});
      best.back().points.push_back({static_cast<double>(count), ours.seconds.median});
      scalar.back().points.push_back({static_cast<double>(count), embree.seconds.median});
      context.progress(0.6 * ++done / static_cast<double>(kinds.size() * counts(context).size()));
    }
  }
  context.page().charts(
      {{"The kernel that is chosen", "one thread", of_shapes, of_seconds, best},
       {"The scalar kernel, by Embree", "one thread", of_shapes, of_seconds, scalar}});
  context.table("shapes", table, "A cloud of shapes of the same total area in a white environment");
}

void bench_small_lights(Context& context) {
  carlo::Table table({"lights", "number", "processor time a path [range]", "1 / (variance s)",
                      "scalar [range]", "scalar 1 / (variance s)"},
                     {"lights", "number", "seconds_a_path", "efficiency", "scalar_seconds_a_path",
                      "scalar_efficiency"});
  std::vector<carlo::Series> series;
  double done = 0;
  for (const bool points : {false, true}) {
    const std::string name = points ? "points" : "rectangles";
    series.push_back({name, {}});
    for (const int count : counts(context)) {
      const Scene scene = lit_floor(count, points);
      const Cost ours = cost(context, scene, Method::best),
                 scalar = cost(context, scene, Method::scalar);
      table.add_row({name, count, seconds_spread_cell(ours.seconds),
                     carlo::number_cell(ours.efficiency), seconds_spread_cell(scalar.seconds),
                     carlo::number_cell(scalar.efficiency)});
      series.back().points.push_back({static_cast<double>(count), ours.seconds.median});
      context.progress(0.6 + 0.4 * ++done / static_cast<double>(2 * counts(context).size()));
    }
  }
  context.page().chart(
      {"Small lights", "one thread; few matter to a point", of_shapes, of_seconds, series});
  context.table(
      "small_lights", table,
      "Small lights close above a floor; the variance is that of the image's mean, relative");
}

}  // namespace

void bench_shapes(Context& context) {
  context.begin("Scaling: shapes");
  context.page().prose(
      "More shapes, or more lights, of which few matter to a path. Few are tried one after the other; "
      "trees find many, so that time grows with the logarithm of their number, and with the "
      "caches' misses.");
  bench_clouds(context);
  bench_small_lights(context);
}

}  // namespace bench
