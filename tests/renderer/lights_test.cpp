#include "renderer/lights.h"

#include "closed_forms.h"
#include "random/rng.h"
#include "renderer/spherical_rectangle.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <vector>

namespace {

using namespace carlo;
using renderer::Lights;
using renderer::RectangleFrame;
using renderer::SphericalRectangle;

Scene lit_by(Shape light) {
  Scene scene;
  scene.materials.emplace_back();
  light.radiance = Rgb(1);
  scene.shapes.push_back(std::move(light));
  return scene;
}

struct Estimate {
  double value, error, relative_sd;
};

/// Irradiance at the origin on a surface with normal n, by sampling the scene's lights.
Estimate irradiance(const Scene& scene, Vec3 n, int count, Vec3 from = Vec3(0)) {
  const Lights lights(scene);
  Rng rng(1);
  double sum = 0, sum2 = 0;
  for (int i = 0; i < count; ++i) {
    const float u_light = rng.uniform_float();
    const float x = rng.uniform_float();
    const float y = rng.uniform_float();
    double e = 0;
    if (const auto s = lights.sample({{from}, n}, u_light, {x, y})) {
      const float cosine = std::max(0.0f, glm::dot(n, glm::normalize(s->p - from)));
      e = static_cast<double>(cosine * s->radiance.r) / (s->pdf > 0 ? s->pdf : 1);
    }
    sum += e;
    sum2 += e * e;
  }
  const double mean = sum / count, sd = std::sqrt(std::max(0.0, sum2 / count - mean * mean));
  return {mean, sd / std::sqrt(count), sd / mean};
}

void check(const Estimate& e, double exact) {
  INFO(e.value << " +- " << e.error << " for " << exact);
  CHECK(std::abs(e.value - exact) <= 5 * e.error + 2e-6 * exact);
  CHECK(e.error <= 0.002 * exact);
}

constexpr int n = 400000;

TEST_CASE("Irradiance from spheres, from far away to nearly touching") {
  // Hard cases 6 and 8: 1 - cos loses the light at R/d = 1e-4; area sampling is useless at 1.01.
  for (const double h : {1.01, 1.5, 2.0, 10.0, 1e3, 5e3, 1e4, 1e6}) {
    const auto d = static_cast<float>(h);
    const Scene scene = lit_by({Sphere{{0, 0, d}, 1}});
    if (h > 2) {
      check(irradiance(scene, {0, 0, 1}, n), closed_forms::sphere_irradiance(h, 0));
    } else {
      check(irradiance(scene, {0, 0, 1}, n), closed_forms::pi / (h * h));
    }
    CHECK(irradiance(scene, {0, 0, 1}, 10000).relative_sd <= 1);
  }
  check(irradiance(lit_by({Sphere{{std::sin(0.87266463f) * 2, 0, std::cos(0.87266463f) * 2}, 1}}),
                   {0, 0, 1}, n),
        .5048442);
}

TEST_CASE("From inside an inward-facing sphere irradiance is pi wherever one stands") {
  // Hard case 7.
  const Scene scene = lit_by({Sphere{{0.2f, -0.3f, 0.4f}, 1, true}});
  for (const Vec3 from : {Vec3(0), Vec3(0.2f, 0.1f, 0.4f), Vec3(0.2f, -0.3f, -0.5f)}) {
    const Estimate e = irradiance(scene, {0, 0, 1}, 4000000, from);
    INFO(e.value << " +- " << e.error);
    CHECK(std::abs(e.value - closed_forms::pi) <= 5 * e.error);
  }
  // From outside, the far half is hidden by the near half.
  const Intersector geometry(scene);
  const Vec3 outside(5, 0, 0);
  for (const Vec2 u : {Vec2(.1f, .2f), Vec2(.5f, .5f), Vec2(.9f, .6f)}) {
    const auto s = Lights(scene).sample({{outside}, {-1, 0, 0}}, 0.5f, u);
    if (!s) continue;
    const Vec3 d = s->p - outside;
    CHECK(geometry.occluded({outside, glm::normalize(d)}, glm::length(d) * (1 - 1e-4f)));
  }
}

TEST_CASE("Irradiance from disks, rectangles, skewed parallelograms and meshes") {
  check(irradiance(lit_by({Disk{{0, 0, 1}, {0, 0, -1}, 1}}), {0, 0, 1}, n), closed_forms::pi / 2);
  check(irradiance(lit_by({Disk{{.5f, 0, 1}, {0, 0, -1}, 1}}), {0, 0, 1}, n), 1.3759630);
  const Parallelogram square{{-.5f, -.5f, 1}, {0, 1, 0}, {1, 0, 0}};
  check(irradiance(lit_by({square}), {0, 0, 1}, n), 4 * closed_forms::rectangle_irradiance(.5, .5));
  // Two halves of the square, as a mesh.
  check(irradiance(lit_by({Mesh{{{-.5f, -.5f, 1}, {-.5f, .5f, 1}, {.5f, .5f, 1}, {.5f, -.5f, 1}},
                                {{0, 1, 2}, {0, 2, 3}}}}),
                   {0, 0, 1}, n),
        .7522747);
  // Lambert's polygon formula for a skewed parallelogram.
  const Parallelogram skewed{{-.5f, -.5f, 1}, {.4f, 1, 0}, {1, 0, 0}};
  const glm::dvec3 corner[4] = {{-.5, -.5, 1}, {-.1, .5, 1}, {.9, .5, 1}, {.5, -.5, 1}};
  double e = 0;
  for (int i = 0; i < 4; ++i) {
    const glm::dvec3 c = glm::cross(corner[i], corner[(i + 1) % 4]);
    e +=
        std::atan2(glm::length(c), glm::dot(corner[i], corner[(i + 1) % 4])) * c.z / glm::length(c);
  }
  check(irradiance(lit_by({skewed}), {0, 0, 1}, n), std::abs(e) / 2);
}

TEST_CASE("A rectangle that touches the floor has small variance next to its edge") {
  // Hard case 9: area sampling at a distance of .001 has an sd of 216 times the mean.
  const Parallelogram wall{{-.5f, .001f, 0}, {1, 0, 0}, {0, 0, 1}};
  const Scene scene = lit_by({wall});
  // The floor point lies on the wall's middle line: two halves of width .5.
  const double exact = 2 * closed_forms::perpendicular_irradiance(1 / .5, .001 / .5);
  const Estimate e = irradiance(scene, {0, 0, 1}, n);
  check(e, exact);
  CHECK(e.relative_sd <= 1);
}

TEST_CASE("The solid angle of rectangles near and far, and the unit square's") {
  const auto omega = [](float half, float z) {
    const Parallelogram s{{-half, -half, z}, {2 * half, 0, 0}, {0, 2 * half, 0}};
    return SphericalRectangle(RectangleFrame(s), Vec3(0)).solid_angle();
  };
  CHECK(std::abs(omega(.5f, 1) - .8054317) <= 1e-6);
  // Centred square: 4 asin(h^2 / (h^2 + z^2)).
  for (const double z : {1e-3, .1, 1.0, 10.0, 1e3}) {
    const double half = .5, exact = 4 * std::asin(half * half / (half * half + z * z));
    CHECK(std::abs(omega(.5f, static_cast<float>(z)) / exact - 1) <= 1e-6);
  }
  CHECK(omega(.5f, 0) == 0);
}

TEST_CASE("pdf() is the density with which sample() gives the point that a ray hits") {
  const std::vector<Shape> shapes = {
      {Parallelogram{{-.5f, -.5f, 1}, {0, 1, 0}, {1, 0, 0}}, 0, Rgb(3)},
      {Sphere{{3, 0, 2}, .5f}, 0, Rgb(1)},
      {Sphere{{0, 0, 0}, 50, true}, 0, Rgb(.0003f)},
      {Disk{{-3, 0, 2}, {0, 0, -1}, 1}, 0, Rgb(2)},
      {Mesh{{{0, 3, 2}, {1, 4, 2}, {0, 4, 2}}, {{0, 2, 1}}}, 0, Rgb(5)}};
  Scene scene;
  scene.materials.emplace_back();
  scene.shapes = shapes;
  const Lights lights(scene);
  const renderer::ShadingPoint here{{}, {0, 0, 1}};
  const Intersector geometry(scene);
  Rng rng(4);
  std::vector<int> seen(shapes.size());
  for (int i = 0; i < 20000; ++i) {
    const float u_light = rng.uniform_float();
    const float x = rng.uniform_float();
    const float y = rng.uniform_float();
    const auto s = lights.sample(here, u_light, {x, y});
    if (!s) continue;
    Hit hit;
    if (!geometry.intersect({Vec3(0), glm::normalize(s->p)}, hit)) continue;
    if (glm::length(hit.p - s->p) > 1e-3f * glm::length(s->p)) continue;  // something is in front
    ++seen[hit.shape];
    CHECK(std::abs(lights.pdf(here, hit) / s->pdf - 1) <= 2e-3f);
  }
  for (const int count : seen)
    CHECK(count > 50);
}

TEST_CASE("beyond() is the density with which sample() gives a direction to the environment map") {
  Scene scene = lit_by({Disk{{0, 5, 1}, {0, 0, -1}, 1}});
  Envmap map{Image(8, 4)};
  for (std::size_t i = 0; i < map.image.pixels.size(); ++i)
    map.image.pixels[i] = Rgb(static_cast<float>(i % 5));
  scene.lights.envmap = map;
  const Lights lights(scene);
  const renderer::ShadingPoint here{{}, {0, 0, 1}};
  Rng rng(6);
  int seen = 0, elsewhere = 0;
  double irradiance = 0;
  constexpr int count = 400000;
  for (int i = 0; i < count; ++i) {
    const float u_light = rng.uniform_float();
    const float x = rng.uniform_float();
    const auto s = lights.sample(here, u_light, {x, rng.uniform_float()});
    if (!s || s->n != Vec3(0)) continue;
    ++seen;
    const Vec3 wi = glm::normalize(s->p);
    CHECK(glm::length(s->p) > 10);  // beyond the disk, as seen from anywhere
    const auto texel = lights.beyond(here, wi);
    elsewhere += texel.radiance == s->radiance && texel.pdf == s->pdf ? 0 : 1;
    irradiance += static_cast<double>(s->radiance.r * std::max(0.0f, wi.z) / s->pdf);
  }
  CHECK(seen > count / 4);
  CHECK(elsewhere <= 4);  // at the texels' edges
  // For the half with z > 0, columns 2 to 5: the sum of L times the integral of the cosine over the
  // texel.
  double exact = 0;
  for (int y = 0; y < 4; ++y) {
    const double a = y * closed_forms::pi / 4, b = a + closed_forms::pi / 4;
    const double of_row = (b - a) / 2 - (std::sin(2 * b) - std::sin(2 * a)) / 4;
    for (int k = 2; k < 6; ++k) {
      const double of_column =
          std::sin((k - 3) * closed_forms::pi / 4) - std::sin((k - 4) * closed_forms::pi / 4);
      exact += static_cast<double>(map.image.at(k, y).r) * of_row * of_column;
    }
  }
  // The contribution of a direction has a standard deviation of about twice the mean.
  CHECK(std::abs(irradiance / count / exact - 1) <= 5 * 2 / std::sqrt(count));
}

TEST_CASE("A point light gives intensity over distance squared, whatever else shines") {
  Scene scene = lit_by({Disk{{0, 5, 1}, {0, 0, -1}, 1}});
  scene.lights.points.push_back({{0, 0, 2}, Rgb(8)});
  const Lights lights(scene);
  Rng rng(5);
  double sum = 0;
  for (int i = 0; i < 200000; ++i) {
    const auto s = lights.sample({{}, {0, 0, 1}}, rng.uniform_float(), {.5f, .5f});
    if (s && s->pdf == 0) sum += static_cast<double>(s->radiance.r);
  }
  // Bernoulli with p near .9: relative sd of the mean < 1e-3.
  CHECK(std::abs(sum / 200000 - 2) <= 5 * 2e-3);
}

}  // namespace
