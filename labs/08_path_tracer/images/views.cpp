#include "images/views.h"

#include "course/cli/source_folder.h"
#include "numeric/robust.h"
#include "scene/load_scene.h"

#include <cmath>
#include <utility>

namespace lab08 {
namespace {

carlo::Scene fitted(carlo::Scene scene, int size) {
  scene.camera.fit_film(size, size);
  return scene;
}

std::uint32_t add_material(carlo::Scene& scene, const carlo::Material& material) {
  scene.materials.push_back(material);
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

/// Looks from `origin` to `target`, z up.
void look(carlo::Camera& camera, Vec3 origin, Vec3 target, float tan_half_fov) {
  camera.origin = origin;
  camera.forward = glm::normalize(target - origin);
  camera.right = glm::normalize(glm::cross(camera.forward, Vec3(0, 0, 1)));
  camera.up = glm::cross(camera.right, camera.forward);
  camera.tan_half_fov = tan_half_fov;
}

}  // namespace

View::View(carlo::Scene scene, int pixels)
    : world(fitted(std::move(scene), pixels)), size(pixels) {}

carlo::Scene cornell_box() {
  return carlo::load_scene(carlo::source_folder() / "common/scenes/cornell_lambert.xml");
}

carlo::Scene room_with_balls() {
  carlo::Scene scene;
  const auto white = add_material(scene, {carlo::Diffuse{Rgb(0.75f)}, true});
  const auto red = add_material(scene, {carlo::Diffuse{{0.65f, 0.08f, 0.06f}}, true});
  const auto green = add_material(scene, {carlo::Diffuse{{0.12f, 0.45f, 0.1f}}, true});
  const auto black = add_material(scene, {carlo::Diffuse{Rgb(0)}, false});
  const auto mirror = add_material(scene, {carlo::Mirror{Rgb(0.9f)}, false});
  const auto glass = add_material(scene, {carlo::Dielectric{1.5f, 1}, false});
  const auto wall = [&](Vec3 origin, Vec3 u, Vec3 v, std::uint32_t material) {
    scene.shapes.push_back({carlo::Parallelogram{origin, u, v}, material, Rgb(0)});
  };
  wall({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, white);
  wall({-1, -1, 2}, {0, 2, 0}, {2, 0, 0}, white);
  wall({-1, 1, 0}, {2, 0, 0}, {0, 0, 2}, white);
  wall({-1, -1, 0}, {0, 2, 0}, {0, 0, 2}, red);
  wall({1, -1, 0}, {0, 0, 2}, {0, 2, 0}, green);
  scene.shapes.push_back(
      {carlo::Parallelogram{{-0.4f, 0.4f, 1.99f}, {0.8f, 0, 0}, {0, -0.8f, 0}}, black, Rgb(7)});
  scene.shapes.push_back({carlo::Sphere{{-0.42f, 0.35f, 0.42f}, 0.42f}, mirror, Rgb(0)});
  scene.shapes.push_back({carlo::Sphere{{0.42f, -0.25f, 0.42f}, 0.42f}, glass, Rgb(0)});
  look(scene.camera, {0, -4.2f, 1}, {0, 0, 0.95f}, 0.32f);
  return scene;
}

carlo::Scene plates() {
  carlo::Scene scene;
  const auto black = add_material(scene, {carlo::Diffuse{Rgb(0)}, false});
  const Vec3 eye(0, -3.5f, 3.5f), lights(0, 3, 2.2f);
  for (int i = 0; i < 4; ++i) {
    const float n = 20 * std::pow(6.0f, static_cast<float>(i));
    const auto polished = add_material(scene, {carlo::Phong{Rgb(0.05f), Rgb(0.6f), n}, false});
    // Each plate is tilted so that it mirrors the row of lights to the eye; they descend like
    // stairs, away from the eye, so that none sees another's front.
    const float y = -0.6f + 0.75f * static_cast<float>(i);
    const Vec3 middle(0, y, -0.3f * static_cast<float>(i));
    const Vec3 normal =
        glm::normalize(glm::normalize(eye - middle) + glm::normalize(lights - middle));
    const Vec3 along = 0.34f * glm::cross(normal, Vec3(1, 0, 0));
    scene.shapes.push_back(
        {carlo::Parallelogram{middle - Vec3(1.7f, 0, 0) - along, {3.4f, 0, 0}, 2.0f * along},
         polished, Rgb(0)});
  }
  const float radii[] = {0.08f, 0.16f, 0.32f, 0.6f};
  const Rgb colours[] = {{1, 0.6f, 0.5f}, {1, 1, 0.6f}, {0.6f, 1, 0.7f}, {0.6f, 0.7f, 1}};
  for (int i = 0; i < 4; ++i) {
    // All have the same power.
    const Rgb radiance = colours[i] * (0.8f / carlo::sqr(radii[i]));
    scene.shapes.push_back(
        {carlo::Sphere{lights + Vec3(-1.9f + 1.15f * static_cast<float>(i), 0, 0), radii[i]}, black,
         radiance});
  }
  look(scene.camera, eye, {0, 0.9f, 0.55f}, 0.47f);
  return scene;
}

SampledPixel traced(const View& view, const Trace& trace) {
  return [&view, trace](int x, int y, int samples, Rng& rng) {
    const Ray ray = view.ray(x, y);
    return mean_of(samples, [&] { return trace(ray, rng); });
  };
}

}  // namespace lab08
