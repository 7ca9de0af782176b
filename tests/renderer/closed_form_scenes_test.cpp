// Whole renders against closed forms. Each mean must lie within 4 standard errors, and the standard
// error must be below .2 %; samples are independent, so that the standard error is unbiased. Seeds
// are fixed, so nothing is left to chance; with another seed each test would fail once in 16 000.

#include "closed_forms.h"
#include "scene_tools.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace scene_tools;

void check_mean(const RenderResult& result, double exact) {
  const MeanRadiance mean = mean_radiance(result.film);
  CHECK(result.counts.bad == 0);
  for (std::size_t c = 0; c < 3; ++c) {
    INFO("channel " << c << ": " << mean.value[c] << " +- " << mean.standard_error[c] << " for "
                    << exact);
    CHECK(std::abs(mean.value[c] - exact) <= 4 * mean.standard_error[c] + 1e-6 * exact);
    CHECK(mean.standard_error[c] <= 0.002 * exact);
  }
}

Scene empty_scene(int size) {
  Scene scene;
  scene.width = scene.height = size;
  scene.sampler = SamplerKind::independent;
  return scene;
}

/// The closed form of the albedo, interpolated in theta, since its sum over n terms is too slow for
/// every ray. With 400 steps the error is below 3e-6, except for the last degree at large n.
class AlbedoTable {
 public:
  explicit AlbedoTable(int n) {
    for (int i = 0; i <= steps; ++i)
      values_.push_back(closed_forms::phong_albedo(n, i * step));
  }
  double operator()(double theta) const {
    const double x = std::min(theta / step, steps - 1e-9);
    const auto i = static_cast<std::size_t>(x);
    const double f = x - static_cast<double>(i);
    return (1 - f) * values_[i] + f * values_[i + 1];
  }

 private:
  static constexpr int steps = 400;
  static constexpr double step = closed_forms::pi / 2 / steps;
  std::vector<double> values_;
};

TEST_CASE("A convex Phong object in a uniform environment shows kd + ks a(n, theta)") {
  // A sphere of radius 1 that fills part of the film. The expected film is the mean over camera
  // rays, by quadrature on a grid of rays much finer than the pixels.
  constexpr float kd = 0.3f, ks = 0.6f;
  for (const int n : {0, 1, 2, 50, 1000, 1000000}) {
    Scene scene = empty_scene(24);
    scene.camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 26);
    scene.lights.environment = Rgb(1);
    scene.materials = {{Phong{Rgb(kd), Rgb(ks), static_cast<float>(n)}, false}};
    scene.shapes = {{Sphere{{0, 0, 0}, 1}}};
    const AlbedoTable albedo(n);
    constexpr int grid = 600;
    double sum = 0;
    for (int i = 0; i < grid * grid; ++i) {
      const int row = i / grid, column = i % grid;
      const Vec2 film((static_cast<float>(column) + .5f) / grid,
                      (static_cast<float>(row) + .5f) / grid);
      const glm::dvec3 d(scene.camera.ray(film).d);
      const double b = 5 * d.z, discriminant = b * b - 24;  // |o + t d| = 1 with o = (0, 0, 5)
      if (discriminant < 0) {
        sum += 1;
        continue;
      }
      const glm::dvec3 p = glm::dvec3(0, 0, 5) + (-b - std::sqrt(discriminant)) * d;
      const double theta = std::acos(-glm::dot(p, d));
      sum += static_cast<double>(kd) + static_cast<double>(ks) * albedo(theta);
    }
    INFO("n = " << n);
    check_mean(render_scene(scene, 512), sum / (grid * grid));
  }
}

TEST_CASE("A mirror and a glass sphere vanish in a uniform environment") {
  for (const Material& material :
       {Material{Mirror{}, false}, Material{Dielectric{1.5f, 1}, false}}) {
    Scene scene = empty_scene(16);
    scene.camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 30);
    scene.lights.environment = Rgb(1);
    scene.materials = {material};
    scene.shapes = {{Sphere{{0, 0, 0}, 1}}};
    const MeanRadiance mean = mean_radiance(render_scene(scene, 256).film);
    // Roulette keeps the mirror exact; in glass radiance grows and shrinks with eta^2.
    CHECK(std::abs(mean.value[0] - 1) <= 4 * mean.standard_error[0] + 1e-5);
    CHECK(mean.standard_error[0] <= 0.002);
  }
}

/// The six faces of a cube of half-width 1, normals inwards.
std::vector<Parallelogram> inward_cube() {
  const Vec3 x(2, 0, 0), y(0, 2, 0), z(0, 0, 2), low(-1), high(1);
  return {{low, x, y}, {low, y, z}, {low, z, x}, {high, -y, -x}, {high, -z, -y}, {high, -x, -z}};
}

TEST_CASE("A closed furnace reads Le / (1 - rho)") {
  for (const double rho : {.1, .5, .9}) {
    for (const bool phong : {false, true}) {
      Scene scene = empty_scene(16);
      scene.camera = look_at({.1f, .2f, .3f}, {1, 1, 1}, {0, 1, 0}, 100);
      const auto albedo = static_cast<float>(rho);
      // A lobe whose ks is 0 everywhere although the model has it: this also tests the bookkeeping
      // of the mixture.
      scene.materials = {phong ? Material{Phong{Rgb(albedo), Rgb(0), 20}, false}
                               : Material{Diffuse{Rgb(albedo)}, false}};
      for (const Parallelogram& face : inward_cube())
        scene.shapes.push_back({face, 0, Rgb(1)});
      check_mean(render_scene(scene, 512), 1 / (1 - rho));
    }
  }
}

TEST_CASE("A furnace cut after K bounces reads Le (1 - rho^(K+1)) / (1 - rho)") {
  Scene scene = empty_scene(16);
  scene.camera = look_at({.1f, .2f, .3f}, {1, 1, 1}, {0, 1, 0}, 100);
  scene.materials = {{Diffuse{Rgb(.8f)}, false}};
  for (const Parallelogram& face : inward_cube())
    scene.shapes.push_back({face, 0, Rgb(1)});
  for (const int segments : {1, 2, 3, 6}) {
    scene.max_depth = segments;
    check_mean(render_scene(scene, 1024), (1 - std::pow(.8, segments)) / .2);
  }
}

TEST_CASE("A spherical furnace, lit from all around, reads Le / (1 - rho)") {
  Scene scene = empty_scene(16);
  scene.camera = look_at({.1f, .2f, .3f}, {1, 1, 1}, {0, 1, 0}, 100);
  scene.materials = {{Diffuse{Rgb(.5f)}, false}};
  scene.shapes = {{Sphere{{0, 0, 0}, 2, true}, 0, Rgb(1)}};
  check_mean(render_scene(scene, 2048), 2);
}

/// A white diffuse floor of reflectance rho, seen in one small spot at the origin.
Scene floor_under(Shape light, double rho) {
  Scene scene = empty_scene(8);
  scene.camera = look_at({.6f, .02f, .05f}, {0, 0, 0}, {0, 1, 0}, .01);
  scene.materials = {{Diffuse{Rgb(static_cast<float>(rho))}, false}, {Diffuse{Rgb(0)}, false}};
  scene.shapes = {{Parallelogram{{-50, 0, -50}, {0, 0, 100}, {100, 0, 0}}}};
  light.material = 1;
  light.radiance = Rgb(2);
  scene.shapes.push_back(std::move(light));
  return scene;
}

TEST_CASE("A floor under a sphere, a disk and rectangles reads rho E / pi") {
  struct Case {
    Shape light;
    double irradiance;
  };
  const double s = std::sin(50 * closed_forms::pi / 180), c = std::cos(50 * closed_forms::pi / 180);
  const std::vector<Case> cases = {
      {{Sphere{{0, 2, 0}, 1}}, closed_forms::sphere_irradiance(2, 0)},
      {{Sphere{{static_cast<float>(-2 * s), static_cast<float>(2 * c), 0}, 1}}, .5048442},
      {{Disk{{0, 1, 0}, {0, -1, 0}, 1}}, closed_forms::disk_irradiance(1, 1, 0)},
      {{Disk{{-.5f, 1, 0}, {0, -1, 0}, 1}}, closed_forms::disk_irradiance(1, 1, .5)},
      {{Parallelogram{{-.5f, 1, -.5f}, {1, 0, 0}, {0, 0, 1}}},
       4 * closed_forms::rectangle_irradiance(.5, .5)},
      {{Parallelogram{{-1, 0, -.5f}, {0, 1, 0}, {0, 0, 1}}},
       2 * closed_forms::perpendicular_irradiance(1 / .5, 1 / .5)}};
  for (const Case& test : cases) {
    INFO("irradiance " << test.irradiance);
    check_mean(render_scene(floor_under(test.light, .7), 8192),
               .7 * 2 * test.irradiance / closed_forms::pi);
  }
}

TEST_CASE("A floor under a point light reads rho I cos / (pi d^2)") {
  Scene scene = floor_under({Disk{{0, 90, 0}, {0, -1, 0}, 1e-3f}}, .7);
  scene.shapes.pop_back();
  scene.lights.points.push_back({{3, 4, 0}, Rgb(10)});
  check_mean(render_scene(scene, 256), .7 * 10 * .8 / 25 / closed_forms::pi);
}

TEST_CASE("Area lights lose nothing far from the origin") {
  // Half of the light points are rounded to behind the light: a shadow ray that ends only a
  // fraction short of the point is then blocked by the light itself, which costs 33 % at 1e4.
  for (const Shape& light :
       {Shape{Disk{{0, 1, 0}, glm::normalize(Vec3(.4f, -1, .2f)), .5f}},
        Shape{Sphere{{0, 1, 0}, .4f}},
        Shape{Parallelogram{{-.3f, .9f, -.3f}, {.5f, .2f, .1f}, {-.1f, .2f, .6f}}},
        Shape{Mesh{{{-.3f, .9f, -.3f}, {.3f, 1, -.3f}, {.1f, 1.2f, .4f}}, {{0, 1, 2}}}}}) {
    double at_origin = 0;
    for (const float offset : {0.0f, 1024.0f, 8192.0f}) {
      const Vec3 o(offset, 0, offset);
      Scene scene = floor_under(light, .7);
      Shape& moved = scene.shapes.back();
      if (auto* s = std::get_if<Disk>(&moved.geometry)) s->center += o;
      if (auto* s = std::get_if<Sphere>(&moved.geometry)) s->center += o;
      if (auto* s = std::get_if<Parallelogram>(&moved.geometry)) s->origin += o;
      if (auto* s = std::get_if<Mesh>(&moved.geometry)) {
        for (Vec3& p : s->positions)
          p += o;
      }
      std::get<Parallelogram>(scene.shapes[0].geometry).origin += o;
      scene.camera = look_at(Vec3(.6f, .5f, .05f) + o, o, {0, 1, 0}, 1);
      const MeanRadiance mean = mean_radiance(render_scene(scene, 4096).film);
      if (offset == 0) at_origin = mean.value[0];
      INFO("offset " << offset << ": " << mean.value[0] << " for " << at_origin);
      CHECK(at_origin > .01);
      // Moving rounds the shapes' own coordinates, by 5e-4 of their size at 8192.
      CHECK(std::abs(mean.value[0] - at_origin) <= 6 * mean.standard_error[0] + 2e-3 * at_origin);
    }
  }
}

TEST_CASE("A cover close to a light lets nothing through") {
  Scene scene = floor_under({Parallelogram{{-1, 10, -1}, {2, 0, 0}, {0, 0, 2}}}, .7);
  scene.shapes.push_back({Parallelogram{{-2, 9.9995f, -2}, {4, 0, 0}, {0, 0, 4}}, 1});
  CHECK(mean_radiance(render_scene(scene, 256).film).value[0] == 0);
}

TEST_CASE("A light that is switched off changes nothing") {
  Scene scene = floor_under({Sphere{{0, 2, 0}, 1}}, .7);
  scene.lights.points.push_back({{0, 3, 0}, Rgb(0)});
  check_mean(render_scene(scene, 8192),
             .7 * 2 * closed_forms::sphere_irradiance(2, 0) / closed_forms::pi);
  scene.shapes.pop_back();
  const RenderResult dark = render_scene(scene, 16);
  CHECK(mean_radiance(dark.film).value[0] == 0);
  CHECK(dark.counts.bad == 0);
}

TEST_CASE("Rectangle lights of tiny solid angle have the right brightness") {
  // The sum of four angles less 2 pi has an absolute accuracy of 1e-15: at a distance of 1e7 sides
  // 3 % would be lost.
  for (const float distance : {1e2f, 1e4f, 1e6f, 1e8f}) {
    Scene scene = floor_under({Parallelogram{{-.5f, distance, -.5f}, {1, 0, 0}, {0, 0, 1}}}, .7);
    scene.shapes.back().radiance = Rgb(2 * distance * distance);
    const MeanRadiance mean = mean_radiance(render_scene(scene, 256).film);
    const double exact = .7 * 2 / closed_forms::pi;
    INFO("distance " << distance << ": " << mean.value[0] << " +- " << mean.standard_error[0]
                     << " for " << exact);
    CHECK(std::abs(mean.value[0] / exact - 1) <= 4 * mean.standard_error[0] / exact + 1e-4);
  }
}

TEST_CASE("A point light's standard error does not depend on the unit of length") {
  double expected = 0;
  for (const float h : {1.0f, 1e-4f, 1e-6f, 1e4f, 1e6f}) {
    Scene scene = empty_scene(16);
    scene.materials = {{Diffuse{Rgb(.5f)}, false}};
    scene.shapes = {{Parallelogram{h * Vec3(-1, 0, -1), h * Vec3(0, 0, 2), h * Vec3(2, 0, 0)}}};
    scene.lights.points = {{h * Vec3(.2f, .3f, .1f), Rgb(1)}};
    scene.camera = look_at(h * Vec3(0, 1.5f, 1.5f), Vec3(0), {0, 1, 0}, 60);
    const MeanRadiance mean = mean_radiance(render_scene(scene, 64).film);
    const double relative = mean.standard_error[0] / mean.value[0];
    if (h == 1) expected = relative;
    CHECK(expected > 1e-5);
    CHECK(std::abs(relative / expected - 1) <= 0.1);
  }
}

TEST_CASE("Paths that would never end are cut and counted") {
  Scene scene = empty_scene(2);
  scene.camera = look_at({.1f, .2f, .3f}, {1, 1, 1}, {0, 1, 0}, 100);
  scene.materials = {{Mirror{Rgb(1)}, false}};
  scene.shapes = {{Sphere{{0, 0, 0}, 2, true}}};
  const RenderResult result = render_scene(scene, 4);
  CHECK(result.counts.cut == 2u * 2 * 4);
  CHECK(mean_radiance(result.film).value[0] == 0);
}

TEST_CASE("A level mirror above the floor shows the floor, dimmed by its reflectance") {
  // The mirror hides part of the light from the floor: both cameras see the spot at x = .55, and
  // the one that looks up at the mirror must see .9 times the radiance that the other sees.
  Scene scene = floor_under({Disk{{0, 1, 0}, {0, -1, 0}, 1}}, .7);
  scene.materials.push_back({Mirror{Rgb(.9f)}, false});
  scene.shapes.push_back({Parallelogram{{.5f, .45f, -.05f}, {.1f, 0, 0}, {0, 0, .1f}}, 2});
  const Vec3 spot(.55f, 0, 0), at_mirror(.55f, .45f, 0);
  scene.camera = look_at({.55f, .4f, 0}, spot, {0, 0, 1}, .001);
  const MeanRadiance direct = mean_radiance(render_scene(scene, 8192, 1).film);
  scene.camera = look_at({.55f, .4f, 0}, at_mirror, {0, 0, 1}, .001);
  const MeanRadiance mirrored = mean_radiance(render_scene(scene, 8192, 2).film);
  const double error = std::hypot(.9 * direct.standard_error[0], mirrored.standard_error[0]);
  CHECK(direct.value[0] > 0.1);
  CHECK(std::abs(mirrored.value[0] - .9 * direct.value[0]) <= 4 * error);
  CHECK(error <= .002 * mirrored.value[0]);
}

}  // namespace
