#include "course/viewer/tiles.h"
#include "experiments.h"
#include "images/images.h"
#include "numeric/robust.h"

#include <algorithm>
#include <cmath>

// Step b: a floor, a square light and a square that hides part of it. Seen from the floor the
// hidden part is a rectangle in the light's plane, so the soft shadow has a closed form.

namespace lab08 {
namespace {

constexpr float light_height = 2, screen_height = 0.7f, albedo = 0.8f, radiance = 4;

/// [x0, x1] x [y0, y1] at some height over the floor.
struct Rectangle {
  double x0, x1, y0, y1;
};
constexpr Rectangle light{-0.6, 0.6, -0.6, 0.6}, screen{-0.5, 0.5, -0.5, 0.5};

carlo::Parallelogram facing_down(const Rectangle& r, float height) {
  const auto f = [](double x) { return static_cast<float>(x); };
  return {{f(r.x0), f(r.y1), height}, {f(r.x1 - r.x0), 0, 0}, {0, f(r.y0 - r.y1), 0}};
}

carlo::Scene scene() {
  carlo::Scene scene;
  scene.materials = {{carlo::Diffuse{Rgb(albedo)}, false}, {carlo::Diffuse{Rgb(0)}, false}};
  scene.shapes = {{carlo::Parallelogram{{-9, -9, 0}, {18, 0, 0}, {0, 18, 0}}, 0, Rgb(0)},
                  {facing_down(light, light_height), 1, Rgb(radiance)},
                  {facing_down(screen, screen_height), 1, Rgb(0)}};
  scene.camera.origin = {0, -3.6f, 1.5f};
  scene.camera.forward = glm::normalize(Vec3(0, 3.6f, -0.75f));
  scene.camera.up = glm::cross(scene.camera.right, scene.camera.forward);
  scene.camera.tan_half_fov = 0.46f;
  return scene;
}

/// Irradiance from a parallel rectangle of radiance 1 with one corner above the point and the
/// opposite one at (x, y), in units of the height. (J. Howell's catalogue of view factors, C-11,
/// times pi.)
double corner(double x, double y) {
  const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
  return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / 2;
}

double irradiance(const Rectangle& r, double height, const Vec3& p) {
  const auto at = [&](double x, double y) {
    return corner((x - static_cast<double>(p.x)) / height, (y - static_cast<double>(p.y)) / height);
  };
  return at(r.x1, r.y1) - at(r.x0, r.y1) - at(r.x1, r.y0) + at(r.x0, r.y0);
}

/// Radiance of the floor at p: that due to the whole light minus that of the part behind the
/// screen.
double exact(const Vec3& p) {
  constexpr double h = light_height, zoom = h / static_cast<double>(screen_height);
  const auto shadow = [&](double edge, float at) {
    return static_cast<double>(at) + (edge - static_cast<double>(at)) * zoom;
  };
  const Rectangle hidden{std::clamp(shadow(screen.x0, p.x), light.x0, light.x1),
                         std::clamp(shadow(screen.x1, p.x), light.x0, light.x1),
                         std::clamp(shadow(screen.y0, p.y), light.y0, light.y1),
                         std::clamp(shadow(screen.y1, p.y), light.y0, light.y1)};
  const double E = irradiance(light, h, p) - irradiance(hidden, h, p);
  return static_cast<double>(albedo) / carlo::pi * E * static_cast<double>(radiance);
}

using Method = Rgb (*)(const World&, const Surface&, const Brdf&, Rng&);

}  // namespace

void direct_experiment(Notebook& notebook) {
  notebook.begin("Step b: direct light, a soft shadow");
  const int size = image_size(notebook, 96);
  carlo::Scene seen = scene();
  seen.camera.fit_film(size, size);
  const World world(std::move(seen));
  const auto surface_at = [&](int x, int y) {
    return world.intersect(middle_ray(world.scene().camera, size, size, x, y));
  };
  const auto is_floor = [](const Surface& surface) { return surface.hit.shape == 0; };
  const Reference reference{render(size, size, 0, [&](int x, int y, Rng&) {
    const auto surface = surface_at(x, y);
    if (!surface) return Rgb(0);
    return is_floor(*surface) ? Rgb(static_cast<float>(exact(surface->p))) : surface->Le;
  })};
  const auto method = [&](Method direct) {
    return [&, direct](int x, int y, int samples, Rng& rng) {
      const auto surface = surface_at(x, y);
      if (!surface) return Rgb(0);
      if (!is_floor(*surface)) return surface->Le;
      const Brdf f = [](Vec3) { return Rgb(albedo / carlo::pi_f); };
      return mean_of(samples, [&] { return direct(world, *surface, f, rng); });
    };
  };
  std::vector<Result> results;
  const auto add = [&](const std::string& name, Method direct) {
    notebook.attempt(
        [&] { results.push_back(measure(notebook, name, reference, 16, method(direct))); });
    notebook.progress(static_cast<double>(results.size()), 2);
  };
  add("area form", direct_by_area);
  add("hemisphere form", direct_by_hemisphere);
  if (results.empty()) return;
  notebook.say(
      "A square light over a floor, and a black square between them. Every point of the floor has a "
      "closed form: the light's irradiance less that of the part which the square hides. Both forms "
      "of the rendering equation integrate the same light; with the same number of samples one "
      "samples points of the light, the other directions of the hemisphere.");
  notebook.raw_html(carlo::tiles(pictures_of(reference, "closed form", results, 1.1)));
  carlo::Table table = results_table();
  add_rows(table, "soft shadow", results);
  notebook.table("direct", table, "Direct light: error, cost and slopes");
  add_charts(notebook, "Soft shadow", results);
}

}  // namespace lab08
