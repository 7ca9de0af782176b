#include "course/viewer/tiles.h"
#include "experiments.h"
#include "images/images.h"

#include <fmt/core.h>

#include <array>

// Step b: one scene at scales from 1e-4 to 1e6. How far off the surface does a shadow ray start?

namespace lab08 {
namespace {

struct ScaledBall {
  Vec3 centre;
  float radius;
};

// On the floor z = 0, a hundred times their size away from the origin, as in a larger scene.
constexpr Vec3 away{100, 0, 0};
constexpr std::array<ScaledBall, 2> balls{
    {{away + Vec3(-0.3f, 0.1f, 0.5f), 0.5f}, {away + Vec3(0.5f, -0.4f, 0.25f), 0.25f}}};
constexpr Vec3 point_light = away + Vec3(1.5f, -1.2f, 2.2f);

carlo::Scene scene(float scale) {
  carlo::Scene scene;
  scene.materials = {{carlo::Diffuse{Rgb(1)}, false}};
  scene.shapes = {{carlo::Parallelogram{scale * (away - Vec3(9, 9, 0)), scale * Vec3(18, 0, 0),
                                        scale * Vec3(0, 18, 0)},
                   0, Rgb(0)}};
  for (const ScaledBall& ball : balls)
    scene.shapes.push_back({carlo::Sphere{scale * ball.centre, scale * ball.radius}, 0, Rgb(0)});
  const Vec3 eye = away + Vec3(0, -3.4f, 1.8f), target = away + Vec3(0, 0, 0.35f);
  scene.camera.origin = scale * eye;
  scene.camera.forward = glm::normalize(target - eye);
  scene.camera.right = Vec3(1, 0, 0);
  scene.camera.up = glm::cross(scene.camera.right, scene.camera.forward);
  scene.camera.tan_half_fov = 0.3f;
  return scene;
}

/// True if the light is visible from a surface point, in double precision.
bool truly_lit(const Surface& surface, float scale) {
  const auto s = static_cast<double>(scale);
  const glm::dvec3 p = glm::dvec3(surface.p) / s, d = glm::dvec3(point_light) - p;
  if (glm::dot(glm::dvec3(surface.n), d) <= 0) return false;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (surface.hit.shape == i + 1) continue;
    const glm::dvec3 to = glm::dvec3(balls[i].centre) - p;
    const double along = glm::dot(to, d) / glm::dot(d, d);
    const auto r = static_cast<double>(balls[i].radius);
    if (along > 0 && along < 1 && glm::length(to - along * d) < r) return false;
  }
  return true;
}

using Lit = bool (*)(const World&, const Surface&, float scale);

/// The shadow ray of many beginners' path tracers: it starts and ends a thousandth off.
bool lit_with_fixed_offset(const World& world, const Surface& surface, float scale) {
  constexpr float offset = 1e-3f;
  const Vec3 d = scale * point_light - surface.p;
  const float distance = glm::length(d);
  const Vec3 wi = d / distance;
  const auto met = world.intersect({surface.p + offset * wi, wi});
  return !met || met->hit.t > distance - 2 * offset;
}

bool lit_as_given(const World& world, const Surface& surface, float scale) {
  return world.sees(surface, {scale * point_light, Vec3(0), Rgb(1), Vec3(0)});
}

struct Shadows {
  carlo::Image image;
  double wrong = 0;  ///< fraction of the pixels
};

Shadows shadows(float scale, int size, Lit lit) {
  carlo::Scene seen = scene(scale);
  seen.camera.fit_film(size, size);
  const World world(std::move(seen));
  const auto surface_at = [&](int x, int y) {
    return world.intersect(middle_ray(world.scene().camera, size, size, x, y));
  };
  const auto lit_at = [&](const Surface& surface) {
    const Vec3 d = scale * point_light - surface.p;
    return glm::dot(surface.n, d) > 0 && lit(world, surface, scale);
  };
  Shadows result{render(size, size, 0, [&](int x, int y, Rng&) {
    const auto surface = surface_at(x, y);
    if (!surface) return Rgb(0);
    const Vec3 wi = glm::normalize(scale * point_light - surface->p);
    const float light = lit_at(*surface) ? glm::dot(surface->n, wi) : 0;
    return Rgb(0.08f + 0.9f * light);
  })};
  int wrong = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const auto surface = surface_at(x, y);
      if (surface && lit_at(*surface) != truly_lit(*surface, scale)) ++wrong;
    }
  }
  result.wrong = static_cast<double>(wrong) / (size * size);
  return result;
}

}  // namespace

void scales_experiment(Notebook& notebook) {
  notebook.begin("Step b: where shadow rays start");
  notebook.say(
      "One scene in metres, in tenths of millimetres, in thousands of kilometres; one shadow ray a "
      "pixel. A ray that starts a fixed thousandth off the surface is right at the scale it was "
      "tried at. In the small scene it starts beyond the balls; in the large one it still starts "
      "inside the surface, whose points are rounded to more than that, and shades itself. "
      "World::leave and World::sees start as far off as rounding requires.");
  carlo::Table table({"scale", "fixed offset: wrong", "as given: wrong"},
                     {"scale", "fixed_wrong", "given_wrong"});
  std::vector<std::string> fixed_row, given_row;
  for (const float scale : {1e-4f, 1e-2f, 1.0f, 1e2f, 1e4f, 1e6f}) {
    const int size = image_size(notebook, 128);
    const Shadows fixed = shadows(scale, size, lit_with_fixed_offset);
    const Shadows given = shadows(scale, size, lit_as_given);
    const auto add = [&](std::vector<std::string>& row, const std::string& how, const Shadows& s) {
      row.push_back(carlo::image_tile(fmt::format("scale {:g}", scale),
                                      how + ": " + carlo::percent_cell(s.wrong).text + " wrong",
                                      s.image, 1));
    };
    add(fixed_row, "offset .001", fixed);
    add(given_row, "as given", given);
    table.add_row({carlo::Cell(fmt::format("{:g}", scale), static_cast<double>(scale)),
                   carlo::percent_cell(fixed.wrong), carlo::percent_cell(given.wrong)});
  }
  notebook.raw_html(carlo::tiles(fixed_row));
  notebook.raw_html(carlo::tiles(given_row));
  notebook.table("scales", table, "Pixels whose shadow is wrong, of one scene at six scales");
}

}  // namespace lab08
