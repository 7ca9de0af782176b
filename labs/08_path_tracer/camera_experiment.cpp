#include "course/viewer/tiles.h"
#include "experiments.h"
#include "images/images.h"
#include "numeric/robust.h"

#include <cmath>

// Step a: a picture that one ray per pixel cannot show, a checkerboard up to the horizon under a
// wheel of spokes.

namespace lab08 {
namespace {

bool odd(float x) {
  return std::lround(std::floor(x)) % 2 != 0;
}

Rgb spokes_and_squares(const Ray& ray) {
  if (ray.d.y < 0) {
    const Vec3 p = ray.d / -ray.d.y;
    return Rgb(odd(2 * p.x) != odd(2 * p.z) ? 1.0f : 0.0f);
  }
  const Vec2 film(-ray.d.x / ray.d.z, -ray.d.y / ray.d.z - 0.5f);
  if (glm::length(film) > 0.45f) return {0.25f, 0.45f, 0.8f};
  constexpr float spokes = 24;
  return odd(std::atan2(film.y, film.x) / carlo::pi_f * spokes) ? Rgb(0) : Rgb(1, 0.85f, 0.5f);
}

}  // namespace

void camera_experiment(Notebook& notebook) {
  notebook.begin("Step a: camera rays");
  notebook.attempt([&] {
    const int size = image_size(notebook, 96);
    carlo::Camera camera;
    camera.fit_film(size, size);
    const auto pixel = [&](int x, int y, int strata, Rng& rng) {
      return pixel_radiance(camera, size, size, x, y, strata, spokes_and_squares, rng);
    };
    const Reference reference = converged(notebook, size, size, 32, pixel);
    const std::vector<Result> results = {
        measure(notebook, "independent rays", reference, 16,
                [&](int x, int y, int samples, Rng& rng) {
                  return mean_of(samples, [&] { return pixel(x, y, 1, rng); });
                }),
        measure(notebook, "stratified rays", reference, 16,
                [&](int x, int y, int samples, Rng& rng) {
                  return pixel(x, y, static_cast<int>(std::lround(std::sqrt(samples))), rng);
                })};
    notebook.say(
        "Spokes and squares finer than a pixel. A pixel is the mean over its little square: with "
        "one ray it is one of the colours in it, and edges become stairs. Stratified: the pixel "
        "is cut into as many squares as it has rays.");
    std::vector<std::string> row =
        pictures_of(reference, "2048 stratified rays a pixel", results, 1);
    const carlo::Image middles = render(size, size, 0, [&](int x, int y, Rng&) {
      return spokes_and_squares(middle_ray(camera, size, size, x, y));
    });
    row.push_back(
        carlo::image_tile("through the middles", "one ray a pixel: aliasing", middles, 1));
    notebook.raw_html(carlo::tiles(row));
    carlo::Table table = results_table();
    add_rows(table, "spokes", results);
    notebook.table("camera", table, "Rays a pixel: error, cost and slopes");
    add_charts(notebook, "Spokes and squares", results);
  });
}

}  // namespace lab08
