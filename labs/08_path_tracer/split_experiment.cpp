#include "course/viewer/tiles.h"
#include "experiments.h"
#include "hemisphere.h"
#include "images/images.h"
#include "numeric/robust.h"
#include "stats/running_mean.h"

#include <fmt/core.h>

#include <cmath>

// Step e: a floor, seen from above, under a small bright ball and a dim sky. Its irradiance has a
// closed form, even where the ball is partly below the horizon.

namespace lab08 {
namespace {

constexpr double floor_albedo = 0.6;

/// A ball of light over a floor z = 0 with normal +z, and a sky of radiance 1.
struct Place {
  Vec3 centre;
  float radius;
  float radiance;  ///< of the ball

  Cone cone(Vec3 p) const { return cone_of(centre, radius, p); }
};

/// Irradiance of the floor at p from a ball of radiance 1. (J. Howell's catalogue of view factors,
/// B-43 and its extension to a ball partly below the horizon, times pi.)
double ball_irradiance(const Place& place, Vec3 p) {
  const glm::dvec3 d = glm::dvec3(place.centre) - glm::dvec3(p);
  const double H2 = glm::dot(d, d) / static_cast<double>(place.radius * place.radius);
  const double cosine = d.z / glm::length(d), sine = std::sqrt(1 - cosine * cosine);
  if (cosine * cosine * H2 >= 1) return cosine > 0 ? carlo::pi * cosine / H2 : 0;
  const double x = std::sqrt(H2 - 1), y = -x * cosine / sine, root = std::sqrt(1 - y * y);
  return (cosine * std::acos(y) - x * sine * root) / H2 + std::atan(sine * root / x);
}

/// The radiance of the floor at p: the parts due to the ball and the sky.
struct Exact {
  double ball = 0, sky = 0;
  double all() const { return ball + sky; }
};

Exact exact(const Place& place, Vec3 p) {
  const double E = ball_irradiance(place, p);
  return {floor_albedo / carlo::pi * static_cast<double>(place.radiance) * E,
          floor_albedo / carlo::pi * (carlo::pi - E)};
}

constexpr Vec3 up{0, 0, 1};

Rgb lambert(Vec3) {
  return Rgb(static_cast<float>(floor_albedo / carlo::pi));
}

using Split = Rgb (*)(const Cone&, Vec3, const Brdf&, const Incoming&, Rng&);

/// One direction of the whole hemisphere.
Rgb whole(const Cone&, Vec3 normal, const Brdf& f, const Incoming& incoming, Rng& rng) {
  const float u = rng.uniform_float();
  const float v = rng.uniform_float();
  const Vec3 local = lab07::sample_uniform_hemisphere({u, v});
  const Vec3 wi = lab07::Frame(normal).to_world(local);
  return f(wi) * incoming(wi) * (local.z / lab07::uniform_hemisphere_pdf(local));
}

Rgb estimate(Split split, const Place& place, Vec3 p, Rng& rng) {
  const Cone cone = place.cone(p);
  const Incoming incoming = [&](Vec3 wi) { return Rgb(cone.contains(wi) ? place.radiance : 1.0f); };
  return split(cone, up, lambert, incoming, rng);
}

struct SplitMethod {
  std::string name;
  Split split;
};

std::vector<SplitMethod> split_methods() {
  return {{"uniform", whole}, {"both rays", reflect_split}, {"one ray", reflect_split_one}};
}

/// Means at one point, and the expected results of the lecture's printed weights there.
void add_point(Notebook& notebook, carlo::Table& table, const std::string& name,
               const Place& place) {
  const Vec3 p(0);
  const Exact e = exact(place, p);
  const auto row = [&](const std::string& method, const carlo::Cell& value, double mean) {
    table.add_row({name, method, e.all(), value, carlo::percent_cell(mean / e.all() - 1)});
  };
  for (const SplitMethod& method : split_methods()) {
    notebook.attempt([&] {
      Rng rng = notebook.rng();
      carlo::RunningMean all;
      for (std::int64_t i = 0; i < notebook.options().n; ++i)
        all.add(static_cast<double>(estimate(method.split, place, p, rng).r));
      row(method.name, carlo::interval_cell(all.mean(), 1.96 * all.error()), all.mean());
    });
  }
  // A direction that is uniform in a set of solid angle W contributes the integral over W on
  // average.
  const Cone cone = place.cone(p);
  const auto inside = static_cast<double>(cone.solid_angle());
  const double outside = 2 * carlo::pi - static_cast<double>(cone.solid_angle_above(up));
  const double to_light = e.ball / inside, elsewhere = e.sky / outside, p_light = 1 / inside;
  const double times = 0.5 * p_light * to_light + 0.5 * (1 - p_light) * elsewhere;
  const double over = to_light / (0.5 * p_light) + elsewhere / (0.5 * (1 - p_light));
  row("as printed, multiplied", carlo::Cell(times), times);
  row("as printed, divided", carlo::Cell(over), over);
}

/// The same mean with light rays alone: the ball's contribution, for the given cone.
double ball_mean(Notebook& notebook, const Place& place, const Cone& cone) {
  const Incoming incoming = [&](Vec3 wi) { return Rgb(cone.contains(wi) ? place.radiance : 0.0f); };
  Rng rng = notebook.rng();
  double sum = 0;
  constexpr int n = 4096;
  for (int i = 0; i < n; ++i)
    sum += static_cast<double>(reflect_split(cone, up, lambert, incoming, rng).r);
  return sum / n;
}

/// The ball shrinks at constant power. 1 - cos(beta), evaluated literally, is a difference of two
/// floats that are nearly 1.
void shrinking_ball(Notebook& notebook) {
  carlo::Table table({"radius / distance", "1 - cos in float", "as given"},
                     {"ratio", "naive", "given"});
  for (const float radius : {1e-1f, 1e-2f, 1e-3f, 5e-4f, 2e-4f, 1e-4f, 1e-5f}) {
    const Place place{{0, 0, 1}, radius, 1 / (radius * radius)};
    const double truth = exact(place, Vec3(0)).ball;
    const Cone given = place.cone(Vec3(0));
    Cone naive = given;
    naive.one_minus_cos = 1 - std::sqrt(1 - radius * radius);
    const auto ratio = [&](const Cone& cone) { return ball_mean(notebook, place, cone) / truth; };
    table.add_row({carlo::Cell(fmt::format("{:g}", radius), static_cast<double>(radius)),
                   ratio(naive), ratio(given)});
  }
  notebook.table("shrinking", table,
                 "A ball that shrinks at constant power: the radiance of the floor under it, "
                 "over the right one. 4096 rays each");
}

}  // namespace

void split_experiment(Notebook& notebook) {
  notebook.begin("Step e: a ray to the light and a ray elsewhere");
  const int size = image_size(notebook, 96);
  const Place over{{0, 0, 1}, 0.1f, 120};
  const auto point = [&](int x, int y) {
    const auto at = [&](int i) {
      return 2 * (2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(size) - 1);
    };
    return Vec3(at(x), -at(y), 0);
  };
  const Reference reference{render(size, size, 0, [&](int x, int y, Rng&) {
    return Rgb(static_cast<float>(exact(over, point(x, y)).all()));
  })};
  std::vector<Result> results;
  for (const SplitMethod& method : split_methods()) {
    notebook.attempt([&] {
      results.push_back(
          measure(notebook, method.name, reference, 16, [&](int x, int y, int samples, Rng& rng) {
            const Vec3 p = point(x, y);
            return mean_of(samples, [&] { return estimate(method.split, over, p, rng); });
          }));
    });
    notebook.progress(static_cast<double>(results.size()), 3);
  }
  if (results.empty()) return;
  notebook.say(
      "A floor seen from above, under a bright ball that fills 1/200 of the hemisphere, and a dim "
      "sky. Uniform directions find the ball once in 200 times; light and non-light rays each have "
      "their own part of the hemisphere. \"Both rays\" traces two a sample, \"one ray\" tosses a "
      "coin.");
  notebook.raw_html(carlo::tiles(pictures_of(reference, "closed form", results, 1.6)));
  carlo::Table table = results_table();
  add_rows(table, "ball and sky", results);
  notebook.table("split", table, "Light and non-light rays: error, cost and slopes");
  add_charts(notebook, "Ball and sky", results);
  carlo::Table means({"place", "weights", "closed form", "mean", "off by"},
                     {"place", "weights", "exact", "mean", "relative"});
  add_point(notebook, means, "under the small ball", over);
  add_point(notebook, means, "beside a ball half set", {{2, 0, 0}, 1, 4});
  notebook.table(
      "split_means", means,
      "Means at one point; what the lecture's weights would give if taken as printed, on "
      "average, with the solid angle as p_light says");
  notebook.attempt([&] { shrinking_ball(notebook); });
}

}  // namespace lab08
