#include "course/viewer/tiles.h"
#include "experiments.h"
#include "hemisphere.h"
#include "images/images.h"
#include "numeric/robust.h"
#include "stats/running_mean.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

// Step c: glossy balls under a sky of radiance 1. Their radiance is their reflectance, which has a
// closed form.

namespace lab08 {
namespace {

/// Directional albedo of the specular lobe for ks = 1 and whole n, at this angle of wo. All terms
/// are positive; the sum ends when they become negligible. (From J. Arvo's recurrences,
/// "Applications of irradiance tensors", SIGGRAPH 1995.)
double specular_albedo(int n, double cosine) {
  const double c = cosine, S = std::sqrt(std::max(0.0, 1 - c * c)), theta = std::acos(c);
  double sum = n % 2 == 0 ? c / 2 : c * (1 - theta / carlo::pi);
  double w = n % 2 == 0 ? carlo::pi / 2 : 1, power = n % 2 == 0 ? 1 : S;
  for (int j = n % 2;; j += 2) {
    sum += c * c / carlo::pi * power * w;
    if (j == n) return sum + power * S * S * w / carlo::pi;
    if (power < 1e-16) return sum;
    power *= S * S;
    w *= (j + 1.0) / (j + 2);
  }
}

carlo::Phong material(int n) {
  return {Rgb(0.3f, 0.15f, 0.1f), Rgb(0.6f), static_cast<float>(n)};
}

carlo::Scene ball(int n, int size) {
  carlo::Scene scene;
  scene.materials = {{material(n), false}};
  scene.shapes = {{carlo::Sphere{{0, 0, 0}, 1}, 0, Rgb(0)}};
  scene.lights.environment = Rgb(1);
  scene.camera.origin = {0, 0, 4};
  scene.camera.tan_half_fov = 0.3f;
  scene.camera.fit_film(size, size);
  return scene;
}

Rgb light_along(const World& world, const Surface& surface, Vec3 wi) {
  const auto met = world.intersect(world.leave(surface, wi));
  return met ? met->Le : world.environment();
}

Rgb uniform_estimate(const World& world, const Surface& surface, Rng& rng) {
  const float u = rng.uniform_float();
  const float v = rng.uniform_float();
  const Vec3 local = lab07::sample_uniform_hemisphere({u, v});
  const Vec3 wi = lab07::Frame(surface.n).to_world(local);
  const float weight = local.z / lab07::uniform_hemisphere_pdf(local);
  return weight * evaluate(surface.phong(), surface.n, surface.wo, wi) *
         light_along(world, surface, wi);
}

Rgb sampled_estimate(const World& world, const Surface& surface, Rng& rng) {
  const float u_lobe = rng.uniform_float();
  const float u = rng.uniform_float();
  const float v = rng.uniform_float();
  const auto next = sample(surface.phong(), surface.n, surface.wo, u_lobe, {u, v});
  if (!next) return Rgb(0);
  return next->weight * light_along(world, surface, next->wi);
}

using Estimate = Rgb (*)(const World&, const Surface&, Rng&);

struct GlossyBall {
  int n;
  Reference reference;
  std::vector<Result> results;
};

GlossyBall measured_ball(Notebook& notebook, int n) {
  const int size = image_size(notebook, 96);
  const World world(ball(n, size));
  const auto surface_at = [&](int x, int y) {
    return world.intersect(middle_ray(world.scene().camera, size, size, x, y));
  };
  GlossyBall result{
      n,
      {render(size, size, 0,
              [&](int x, int y, Rng&) {
                const auto surface = surface_at(x, y);
                if (!surface) return Rgb(0);
                const auto cosine = static_cast<double>(glm::dot(surface->n, surface->wo));
                const carlo::Phong phong = material(n);
                return phong.kd + phong.ks * static_cast<float>(specular_albedo(n, cosine));
              })},
      {}};
  const auto method = [&](Estimate estimate) {
    return [&, estimate](int x, int y, int samples, Rng& rng) {
      const auto surface = surface_at(x, y);
      if (!surface) return Rgb(0);
      return mean_of(samples, [&] { return estimate(world, *surface, rng); });
    };
  };
  result.results.push_back(measure(notebook, fmt::format("uniform, n = {}", n), result.reference,
                                   16, method(uniform_estimate)));
  result.results.push_back(measure(notebook, fmt::format("sample(), n = {}", n), result.reference,
                                   16, method(sampled_estimate)));
  return result;
}

/// Means of sample()'s weights beside the closed form.
carlo::Table albedo_table(Notebook& notebook) {
  carlo::Table table({"n", "angle", "closed form", "measured", "standard errors apart"},
                     {"n", "degrees", "exact", "measured", "z"});
  const auto count = static_cast<int>(notebook.options().n / 8);
  for (const int n : {1, 50, 1000, 1'000'000}) {
    for (const int degrees : {0, 60, 80, 89}) {
      const double angle = degrees * carlo::pi / 180;
      const Vec3 wo(std::sin(angle), 0, std::cos(angle));
      const carlo::Phong phong{Rgb(0), Rgb(1), static_cast<float>(n)};
      Rng rng = notebook.rng();
      carlo::RunningMean weights;
      for (int i = 0; i < count; ++i) {
        const float u_lobe = rng.uniform_float();
        const float u = rng.uniform_float();
        const float v = rng.uniform_float();
        const auto next = sample(phong, {0, 0, 1}, wo, u_lobe, {u, v});
        weights.add(next ? static_cast<double>(next->weight.r) : 0);
      }
      const double mean = weights.mean(), error = weights.error();
      const double exact = specular_albedo(n, std::cos(angle));
      table.add_row({n, carlo::Cell(fmt::format("{}°", degrees), degrees), exact,
                     carlo::interval_cell(mean, std::max(1.96 * error, 1e-7)),
                     error > 1e-7 ? carlo::Cell((mean - exact) / error) : carlo::empty_cell()});
    }
  }
  return table;
}

}  // namespace

void phong_experiment(Notebook& notebook) {
  notebook.begin("Step c: the modified Phong BRDF");
  notebook.attempt([&] {
    std::vector<GlossyBall> balls;
    for (const int n : {1, 10, 100, 1000}) {
      notebook.progress(static_cast<double>(balls.size()), 4);
      balls.push_back(measured_ball(notebook, n));
    }
    notebook.say(
        "Balls of rising exponent n under a sky of radiance 1: what they show is k_d + k_s a(n, "
        "angle), and a has a closed form. It falls towards the rim, to the cosine for large n: "
        "part of the lobe lies below the horizon there. Uniform directions seldom meet a narrow "
        "lobe; sample()'s directions are made for it.");
    carlo::Table table = results_table();
    std::vector<std::string> pictures;
    for (const GlossyBall& ball : balls) {
      const std::string note = fmt::format("closed form, n = {}", ball.n);
      for (std::string& picture : pictures_of(ball.reference, note, ball.results, 1))
        pictures.push_back(std::move(picture));
      add_rows(table, "ball", ball.results);
    }
    notebook.raw_html(carlo::tiles(pictures));
    notebook.table("phong", table, "Balls under the sky: error, cost and slopes");
    notebook.table("albedo", albedo_table(notebook),
                   "The specular lobe's reflectance, k_s = 1, by sample()'s mean weight");
    std::vector<Result> two = balls[1].results;
    two.insert(two.end(), balls[3].results.begin(), balls[3].results.end());
    add_charts(notebook, "Balls of n = 10 and n = 1000", two);
  });
}

}  // namespace lab08
