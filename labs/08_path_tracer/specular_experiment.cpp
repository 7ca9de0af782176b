#include "course/viewer/tiles.h"
#include "experiments.h"
#include "images/views.h"
#include "numeric/robust.h"
#include "stats/running_mean.h"

#include <fmt/core.h>

#include <cmath>

// Step g: balls of mirror and of glass, and worlds of mirrors and glass with closed forms.

namespace lab08 {
namespace {

/// A sphere seen from inside that emits 1, and a ball of glass at its centre.
carlo::Scene furnace(const carlo::Material& wall, bool with_glass) {
  carlo::Scene scene;
  scene.materials = {wall, {carlo::Dielectric{1.5f, 1}, false}};
  scene.shapes = {{carlo::Sphere{{0, 0, 0}, 2, true}, 0, Rgb(1)}};
  if (with_glass) scene.shapes.push_back({carlo::Sphere{{0, 0, 0}, 0.5f}, 1, Rgb(0)});
  return scene;
}

/// A ball under a sky of 1.
carlo::Scene under_sky(const carlo::Material& ball) {
  carlo::Scene scene;
  scene.materials = {ball};
  scene.shapes = {{carlo::Sphere{{0, 0, 0}, 0.5f}, 0, Rgb(0)}};
  scene.lights.environment = Rgb(1);
  return scene;
}

struct Known {
  std::string name;
  carlo::Scene scene;
  double exact;
};

carlo::Table closed_forms(Notebook& notebook) {
  carlo::Table table({"world", "closed form", "mean"}, {"world", "exact", "mean"});
  const std::vector<Known> worlds = {
      {"a mirror of .7 under the sky", under_sky({carlo::Mirror{Rgb(0.7f)}, false}), 0.7},
      {"glass under the sky", under_sky({carlo::Dielectric{1.5f, 1}, false}), 1},
      {"glass before a glowing black wall", furnace({carlo::Diffuse{Rgb(0)}, false}, true), 1},
      {"glass in a furnace of albedo .5", furnace({carlo::Diffuse{Rgb(0.5f)}, false}, true), 2}};
  for (const Known& known : worlds) {
    const World world(known.scene);
    Rng rng = notebook.rng();
    const std::int64_t n = notebook.options().n / 4;
    carlo::RunningMean radiance;
    for (std::int64_t i = 0; i < n; ++i) {
      // Rays that hit the ball at all distances from its middle.
      const Vec3 target(0.4f * rng.uniform_float(), 0, 0);
      const Ray ray{{0, 0, 1.5f}, glm::normalize(target - Vec3(0, 0, 1.5f))};
      radiance.add(static_cast<double>(trace_specular(world, ray, true, rng).g));
    }
    table.add_row({known.name, known.exact,
                   carlo::interval_cell(radiance.mean(), std::max(1.96 * radiance.error(), 1e-6))});
  }
  return table;
}

/// Fresnel's reflectance by the angle, entering glass and leaving it.
carlo::Chart fresnel_chart() {
  carlo::Chart chart{"Fresnel's reflectance of glass, n = 1.5",
                     "it reaches 1 at 41.8 degrees from within",
                     {"angle in degrees", carlo::Unit::degrees, carlo::Scale::linear},
                     {"reflectance", carlo::Unit::number, carlo::Scale::linear},
                     {{"from outside", {}}, {"from within", {}}}};
  for (int degrees = 0; degrees <= 90; ++degrees) {
    const auto cosine = static_cast<float>(std::cos(degrees * carlo::pi / 180));
    for (std::size_t side = 0; side < 2; ++side) {
      const float F = fresnel(std::max(cosine, 0.0f), side == 0 ? 1 / 1.5f : 1.5f);
      chart.series[side].points.push_back({static_cast<double>(degrees), static_cast<double>(F)});
    }
  }
  return chart;
}

}  // namespace

void specular_experiment(Notebook& notebook) {
  notebook.begin("Step g: mirrors and glass");
  const View view(room_with_balls(), image_size(notebook, 96));
  notebook.attempt([&] {
    const auto specular = traced(
        view, [&](const Ray& ray, Rng& rng) { return trace_specular(view.world, ray, true, rng); });
    const Reference reference =
        converged(notebook, view.size, view.size, most_samples(notebook), specular);
    notebook.progress(1, 2);
    const std::vector<Result> results = {measure(notebook, "Lab 8.7", reference, 16, specular)};
    notebook.say(
        "A ball of mirror and a ball of glass under a square light. No shadow ray reaches the light "
        "through glass: light that it focuses on the floor, a caustic, is found only by paths that "
        "leave the floor, pass the glass and meet the light by chance. Its pixels are the noisiest. "
        "The reference is a long run of the same code; its own error is subtracted.");
    notebook.raw_html(carlo::tiles(pictures_of(
        reference, fmt::format("{} samples a pixel", 2 * most_samples(notebook)), results, 1.2)));
    carlo::Table table = results_table();
    add_rows(table, "balls", results);
    notebook.table("specular", table, "Mirror and glass: error, cost and slopes");
    add_charts(notebook, "Balls of mirror and glass", results);
    notebook.table("specular_means", closed_forms(notebook),
                   "Worlds of mirror and glass with a closed form, with 95 % interval");
  });
  notebook.attempt([&] { notebook.charts({fresnel_chart()}); });
}

}  // namespace lab08
