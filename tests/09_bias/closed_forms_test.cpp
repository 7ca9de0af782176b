// Parts of lab 9 with closed forms: the density of photons under a point light and in a sphere,
// and filters, whose weights add up to 1. Means are judged with theory's standard deviation: eight
// z tests at |z| < 5.5 raise a false alarm for less than 1e-6 of all seeds.

#include "bias.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

using namespace lab09;

namespace {

constexpr double pi = std::numbers::pi;

/// With this BRDF, radiance is irradiance.
Rgb one(Vec3) {
  return Rgb(1);
}

bool agree(double is, double exact, double sd) {
  return std::abs(is - exact) < 5.5 * sd;
}

std::uint32_t add(carlo::Scene& scene, float albedo) {
  scene.materials.push_back({carlo::Diffuse{Rgb(albedo)}, false});
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

/// The mean irradiance on a disc of the floor from a point light of intensity 1 at height 1:
/// cos/d^2, summed over rings and turns by their middles.
double mean_below_light(double x, double y, double radius) {
  constexpr int rings = 200, turns = 200;
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double r = radius * std::sqrt((i + 0.5) / rings);  // rings of equal area
    for (int k = 0; k < turns; ++k) {
      const double turn = 2 * pi * (k + 0.5) / turns;
      const double px = x + r * std::cos(turn), py = y + r * std::sin(turn);
      sum += std::pow(px * px + py * py + 1, -1.5);
    }
  }
  return sum / (rings * turns);
}

}  // namespace

TEST_CASE("density: the floor under a point light") {
  carlo::Scene scene;
  scene.shapes = {{carlo::Parallelogram{{-4, -4, 0}, {8, 0, 0}, {0, 8, 0}}, add(scene, 0), Rgb(0)}};
  const World world(scene);
  constexpr std::int64_t emitted = 1'000'000;
  Rng rng(9);
  std::vector<Photon> photons;
  for (std::int64_t i = 0; i < emitted; ++i) {
    trace_photon(world, emit_from_point({0, 0, 1}, Rgb(1), rng), rng,
                 [&](const Photon& photon) { photons.push_back(photon); });
  }
  const PhotonMap map(std::move(photons), 1 / static_cast<float>(emitted));
  // At the foot the disc's fraction of all light is that of a cone.
  const double foot = 2 * (1 - 1 / std::hypot(1, 0.4)) / (0.4 * 0.4);
  CHECK(std::abs(mean_below_light(0, 0, 0.4) / foot - 1) < 1e-4);
  for (const auto& [x, y, radius] : std::vector<std::array<float, 3>>{
           {0, 0, 0.4f}, {0, 0, 0.05f}, {1, 0, 0.1f}, {-1.5f, 2, 0.2f}}) {
    const auto floor = world.intersect(Ray{{x, y, 0.5f}, {0, 0, -1}});
    REQUIRE(floor);
    const double r = static_cast<double>(radius);
    const double exact = mean_below_light(static_cast<double>(x), static_cast<double>(y), r);
    const double share = exact * r * r / 4;
    const double is = static_cast<double>(radiance_within(map, *floor, one, radius).g);
    CAPTURE(x, y, radius, is, exact);
    CHECK(agree(is, exact, exact * std::sqrt((1 - share) / share / emitted)));
  }
}

TEST_CASE("density: in a closed sphere of albedo rho the irradiance is pi/(1 - rho)") {
  constexpr double albedo = 0.5, radius = 2;
  carlo::Scene scene;
  scene.shapes = {{carlo::Sphere{{0, 0, 0}, static_cast<float>(radius), true},
                   add(scene, static_cast<float>(albedo)), Rgb(1)}};
  const World world(scene);
  constexpr int emitted = 200'000, points = 400;
  constexpr double disc = 0.2;
  Rng rng(9);
  std::vector<Photon> photons;
  for (int i = 0; i < emitted; ++i) {
    trace_photon(world, emit_photon(world, rng), rng,
                 [&](const Photon& photon) { photons.push_back(photon); });
  }
  const PhotonMap map(std::move(photons), 1 / static_cast<float>(emitted));
  double mean = 0;
  for (int i = 0; i < points; ++i) {
    const auto wall = world.intersect(emit_from_point(Vec3(0), Rgb(1), rng).ray);
    REQUIRE(wall);
    mean +=
        static_cast<double>(radiance_within(map, *wall, one, static_cast<float>(disc)).g) / points;
  }
  // A distance of d from a point of a sphere encloses an area of pi d^2. The number of times a
  // photon is stored is geometric; the counts of neighbouring discs are practically independent.
  const double stored = 1 / (1 - albedo), share = disc * disc / (4 * radius * radius);
  const double exact = pi * stored;
  const double of_power = albedo / emitted, of_discs = 1 / (emitted * stored * share * points);
  CAPTURE(mean, exact);
  CHECK(agree(mean, exact, exact * std::sqrt(of_power + of_discs)));
}

namespace {

/// Filters of each curve: wide and narrow, cut early and late.
std::vector<PixelFilter> pixel_filters() {
  using Curve = PixelFilter::Curve;
  return {{Curve::box, 0.5, 0},     {Curve::box, 1.7, 0},        {Curve::tent, 1, 0},
          {Curve::tent, 0.3, 0},    {Curve::gaussian, 1.5, 0.5}, {Curve::gaussian, 0.2, 1},
          {Curve::gaussian, 3, 0.5}};
}

/// Colours, depths and normals that all differ, with noise.
FeatureImage drawn_image(Rng& rng) {
  FeatureImage image(9, 7);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      FeaturePixel& pixel = image.at(x, y);
      pixel.albedo = Rgb(0.1f * rng.uniform_float());
      pixel.normal = glm::normalize(Vec3(0.1f * rng.uniform_float(), 0, 1));
      pixel.depth = 1 + 0.1f * rng.uniform_float();
      pixel.variance = Rgb(1);
    }
  }
  return image;
}

}  // namespace

TEST_CASE("filters: a pixel filter's weights add up to 1") {
  for (const PixelFilter& filter : pixel_filters()) {
    // Cells end where the filter does, and at its middle.
    constexpr int cells = 400;
    const double cell = 2 * filter.radius / cells;
    double sum = 0;
    for (int i = 0; i < cells; ++i) {
      for (int k = 0; k < cells; ++k) {
        sum += cell * cell *
               filter_value(filter, (i + 0.5) * cell - filter.radius,
                            (k + 0.5) * cell - filter.radius);
      }
    }
    CAPTURE(static_cast<int>(filter.curve), filter.radius, filter.sigma);
    CHECK(std::abs(sum - 1) < 1e-4);
  }
}

TEST_CASE("filters: what is of one colour keeps it, however few the rays") {
  carlo::Camera camera;
  camera.fit_film(8, 8);
  Rng rng(9);
  const Radiance grey = [](const Ray&) { return Rgb(0.7f, 1, 3e4f); };
  for (const PixelFilter& filter : pixel_filters()) {
    for (const int samples : {1, 2, 1000}) {
      for (const auto& pixel : {filtered_pixel, weighted_pixel}) {
        const Rgb is = pixel(camera, 8, 8, 3, 4, filter, samples, grey, rng) / Rgb(0.7f, 1, 3e4f);
        CHECK(glm::length(is - Rgb(1)) < 1e-5f);
      }
    }
  }
}

TEST_CASE("filters: the feature filter's weights add up to 1, also at the image's edges") {
  // For one white pixel in a black image the filter shows its weight at each position: since
  // colours make no difference where k is huge, such images add up to white.
  Rng rng(9);
  const FeatureImage black = drawn_image(rng);
  FilterStrength strength;
  strength.radius = 2;
  strength.color = 1e9;
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(8, 3), std::pair(4, 3)}) {
    double sum = 0, largest = 0;
    for (int row = 0; row < black.height(); ++row) {
      for (int column = 0; column < black.width(); ++column) {
        FeatureImage image = black;
        image.at(column, row).color = Rgb(1);
        const auto weight = static_cast<double>(filter_pixel(image, x, y, strength).color.g);
        sum += weight;
        largest = std::max(largest, weight);
      }
    }
    CAPTURE(x, y, largest);
    CHECK(std::abs(sum - 1) < 1e-5);
    CHECK(largest < 0.9);
  }
}
