// Whole renders of signed distance functions against closed forms and against the same shape
// without an sdf. Tolerances as in closed_form_scenes_test.cpp.

#include "scene_tools.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>

namespace {

using namespace scene_tools;

Scene empty_scene(int size) {
  Scene scene;
  scene.width = scene.height = size;
  scene.sampler = SamplerKind::independent;
  return scene;
}

Sdf ball(Vec3 center, double radius) {
  return {{sdf::Solid{sdf::Ball{1}, {}}}, {glm::dmat3(1), glm::dvec3(center), radius}, false};
}

Sdf one_of(sdf::Solid solid) {
  return {{solid}, {}, false};
}

/// The wall of a gyroid inside a ball of radius 1.
Sdf cut_gyroid() {
  return {{sdf::Solid{sdf::Ball{1}, {}}, sdf::Solid{sdf::Gyroid{0.9, 0.1}, {}},
           sdf::Combine{sdf::Operation::intersect, 0.02}},
          {},
          false};
}

TEST_CASE("A convex diffuse sdf in a uniform environment shows its reflectance") {
  // The shape fills the camera's narrow view.
  for (const Sdf& shape : {ball(Vec3(0), 1), one_of({sdf::RoundedBox{{1, 1, 1}, 0.3}, {}}),
                           one_of({sdf::Capsule{{-1, 0, 0}, {1, 0, 0}, 1}, {}})}) {
    Scene scene = empty_scene(16);
    scene.camera = look_at({1, 2, 4}, {0, 0, 0}, {0, 1, 0}, 10);
    scene.lights.environment = Rgb(1);
    scene.materials = {{Diffuse{Rgb(.6f)}, false}};
    scene.shapes = {{shape}};
    const MeanRadiance mean = mean_radiance(render_scene(scene, 256).film);
    CHECK(std::abs(mean.value[0] - .6) <= 4 * mean.standard_error[0] + 1e-6);
  }
}

TEST_CASE("An sdf ball in a closed furnace is not seen: all reads Le / (1 - rho)") {
  // Walls emit 1/2 and reflect 1/2; the ball inside reflects 1, so that its reflected radiance is
  // the furnace's 1. A ray that met its own start or leaked would be dark.
  Scene scene = empty_scene(16);
  scene.camera = look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40);
  scene.materials = {{Diffuse{Rgb(.5f)}, false}, {Diffuse{Rgb(1)}, false}};
  for (const Sdf& shape : {ball(Vec3(0), 1), cut_gyroid()}) {
    scene.shapes = {{Sphere{{0, 0, 0}, 6, true}, 0, Rgb(.5f)}, {shape, 1}};
    const RenderResult result = render_scene(scene, 256);
    const MeanRadiance mean = mean_radiance(result.film);
    INFO(mean.value[0] << " +- " << mean.standard_error[0]);
    CHECK(result.counts.bad == 0);
    CHECK(std::abs(mean.value[0] - 1) <= 4 * mean.standard_error[0] + 1e-5);
    CHECK(mean.standard_error[0] <= .01);
  }
}

TEST_CASE("Glass and mirror sdfs vanish in a uniform environment") {
  for (const Material& material :
       {Material{Mirror{}, false}, Material{Dielectric{1.5f, 1}, false}}) {
    for (const Sdf& shape : {ball(Vec3(0), 1), one_of({sdf::Torus{.7, .3}, {}}), cut_gyroid()}) {
      Scene scene = empty_scene(16);
      scene.camera = look_at({0, 2, 5}, {0, 0, 0}, {0, 1, 0}, 30);
      scene.lights.environment = Rgb(1);
      scene.materials = {material};
      scene.shapes = {{shape}};
      const RenderResult result = render_scene(scene, 64);
      const MeanRadiance mean = mean_radiance(result.film);
      INFO(mean.value[0] << " +- " << mean.standard_error[0]);
      CHECK(result.counts.bad == 0);
      CHECK(result.counts.cut == 0);
      CHECK(std::abs(mean.value[0] - 1) <= 4 * mean.standard_error[0] + 1e-5);
      CHECK(mean.standard_error[0] <= .01);
    }
  }
}

/// A light over a floor, with a sphere of glass between.
Scene glass_scene(decltype(Shape::geometry) sphere) {
  Scene scene = empty_scene(32);
  scene.camera = look_at({0, 2, 5}, {0, .6f, 0}, {0, 1, 0}, 35);
  scene.materials = {{Diffuse{Rgb(.7f)}, false}, {Dielectric{1.5f, 1}, false}};
  scene.shapes = {{Parallelogram{{-3, -.5f, -3}, {0, 0, 6}, {6, 0, 0}}},
                  {Sphere{{1, 3, 0}, .7f}, 0, Rgb(8)},
                  {std::move(sphere), 1}};
  return scene;
}

TEST_CASE("A glass ball by sphere tracing looks like a glass sphere") {
  // Independent seeds: the means differ only by their standard errors.
  const Vec3 center(.2f, .6f, .1f);
  const RenderResult a = render_scene(glass_scene(Sphere{center, 1}), 1024, 1);
  const RenderResult b = render_scene(glass_scene(ball(center, 1)), 1024, 2);
  const MeanRadiance first = mean_radiance(a.film), second = mean_radiance(b.film);
  INFO(first.value[0] << " +- " << first.standard_error[0] << ", " << second.value[0] << " +- "
                      << second.standard_error[0]);
  const double error = std::hypot(first.standard_error[0], second.standard_error[0]);
  CHECK(std::abs(first.value[0] - second.value[0]) <= 4 * error);
  CHECK(error <= .01 * first.value[0]);
  CHECK(b.counts.bad == 0);
  // Same seed: the paths are the same up to rounding, and so is the noise.
  const MeanRadiance same = mean_radiance(render_scene(glass_scene(ball(center, 1)), 1024, 1).film);
  CHECK(std::abs(first.value[0] - same.value[0]) <= .2 * first.standard_error[0]);
}

}  // namespace
